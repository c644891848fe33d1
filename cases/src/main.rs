//! The program `anechoic`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(anechoic::cli::main())
}
