//! Where results go: the standard output, or a file that is replaced only when the new one is whole.

use super::Failure;
use clap::{Arg, ArgMatches};
use ringroad::error::Error;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The option `--out`.
pub(crate) fn option() -> Arg {
    Arg::new("out")
        .long("out")
        .value_name("FILE")
        .help("Write to a file, whole or not at all, instead of the standard output")
}

/// A place to write to, checked before the work begins.
pub(crate) enum Output {
    /// The standard output.
    Standard,
    /// A file.
    File(String),
}

impl Output {
    /// What `--out` says. A folder that does not exist is refused now, not after an hour's run.
    pub(crate) fn new(matches: &ArgMatches) -> Result<Self, Failure> {
        let Some(name) = matches.get_one::<String>("out") else { return Ok(Self::Standard) };
        let refuse =
            |allowed: &'static str| Err(Error::out_of_range("--out", format!("“{name}”"), allowed).into());
        let path = Path::new(name);
        if path.file_name().is_none() || path.is_dir() {
            return refuse("the name of a file");
        }
        if !folder(path).is_dir() {
            return refuse("a file in a folder that exists");
        }
        Ok(Self::File(name.clone()))
    }

    /// Writes all of it.
    pub(crate) fn write(&self, text: &str) -> Result<(), Failure> {
        match self {
            Self::Standard => {
                let mut out = io::stdout().lock();
                out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|error| {
                    match error.kind() {
                        io::ErrorKind::BrokenPipe => Failure::ReaderGone,
                        _ => Failure::File { name: "standard output".into(), error },
                    }
                })
            }
            Self::File(name) => {
                replace(Path::new(name), text).map_err(|error| Failure::File { name: name.clone(), error })
            }
        }
    }
}

fn folder(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Writes a temporary file beside the target and renames it when it is whole.
fn replace(path: &Path, text: &str) -> io::Result<()> {
    // A link is followed; a pipe or a device cannot be replaced and is written to.
    let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    if fs::metadata(&path).is_ok_and(|m| !m.is_file()) {
        return fs::write(&path, text);
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let temporary = folder(&path).join(format!(".{name}.{}.tmp", std::process::id()));
    let written = fs::write(&temporary, text).and_then(|()| fs::rename(&temporary, &path));
    if written.is_err() {
        let _ = fs::remove_file(&temporary);
    }
    written
}
