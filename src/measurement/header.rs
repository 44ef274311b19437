//! The words of CSV headers, all in one place, and how a header is written and read.
//!
//! A file begins with the line `# ringroad VERSION`. Further lines of the form `# WORD TEXT` say what the table was made from.

use crate::error::{Error, opening};
use crate::format::table::Table;

/// Version that a file names: a run is promised to repeat to the last bit within one.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What a line of the header is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Word {
    /// The version of the program: the first line.
    Program,
    /// A scenario, as JSON.
    Scenario,
    /// The measurement of one run, as JSON.
    Measurement,
    /// What theory computed from the scenario, in words.
    Computed,
    /// The plan of a batch, as JSON.
    Plan,
    /// The name of a table of a figure.
    FigureTable,
    /// How a table of a figure was made from many runs or theory, in words.
    MadeFrom,
}

impl Word {
    /// The beginning of the line, up to its text.
    fn prefix(self) -> &'static str {
        match self {
            Self::Program => "# ringroad ",
            Self::Scenario => "# scenario ",
            Self::Measurement => "# measurement ",
            Self::Computed => "# computed ",
            Self::Plan => "# plan ",
            Self::FigureTable => "# figure table ",
            Self::MadeFrom => "# made from ",
        }
    }

    /// The text of the first header line of this kind in a file.
    pub(crate) fn read(self, file: &str) -> Result<&str, Error> {
        let prefix = self.prefix();
        let mut header = file.lines().take_while(|line| line.starts_with('#'));
        header.find_map(|line| line.strip_prefix(prefix)).ok_or_else(|| {
            Error::not_ours(
                "CSV header",
                opening(file),
                format!("a file of Ringroad, with a line “{prefix}…”"),
            )
        })
    }
}

/// A table as CSV below the line that names the program, and these lines.
pub(crate) fn with_header(table: &Table, lines: &[(Word, &str)]) -> String {
    let mut out = String::new();
    for (word, text) in [(Word::Program, VERSION)].iter().chain(lines) {
        out.push_str(word.prefix());
        out.push_str(text);
        out.push('\n');
    }
    table.write_body(&mut out);
    out
}
