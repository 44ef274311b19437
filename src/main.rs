//! The command `ringroad`.

mod command;

fn main() -> std::process::ExitCode {
    command::main()
}
