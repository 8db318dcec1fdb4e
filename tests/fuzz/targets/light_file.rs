//! Any bytes as a light file.

#![no_main]

#[path = "../light_file.rs"]
mod light_file;
#[path = "../limit.rs"]
mod limit;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| light_file::exercise(bytes));
