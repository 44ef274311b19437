//! A progress bar with the time left, on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;

/// A bar of so many steps; hidden where the standard error stream is not a terminal.
pub(crate) fn bar(steps: u64) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style =
        ProgressStyle::with_template("{wide_bar} {percent:>3} %  {eta} left").expect("a valid template");
    ProgressBar::new(steps).with_style(style)
}
