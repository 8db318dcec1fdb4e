//! Any bytes as a `.btf` container.

#![no_main]

#[path = "../btf_file.rs"]
mod btf_file;
#[path = "../limit.rs"]
mod limit;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| btf_file::exercise(bytes));
