//! Any bytes as a recipe.

#![no_main]

#[path = "../limit.rs"]
mod limit;
#[path = "../recipe.rs"]
mod recipe;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| recipe::exercise(bytes));
