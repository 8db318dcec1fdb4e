//! Any bytes as an image's name.

#![no_main]

#[path = "../image_name.rs"]
mod image_name;
#[path = "../limit.rs"]
mod limit;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| image_name::exercise(bytes));
