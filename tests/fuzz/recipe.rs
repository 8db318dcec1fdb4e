//! What is done with bytes that may be a recipe, by its fuzz target, by the test of its corpus and by that of its mutations.

use std::path::Path;

use overpaint::io::{RecipeError, paints, recipe};

/// Reads a recipe and a file of paints. What is read can be painted, what is not is told by its place.
pub fn exercise(bytes: &[u8]) {
    match recipe::parse("recipe", bytes, Path::new("nowhere")) {
        Ok(recipe) => {
            assert!((1..=4096).contains(&(recipe.repeat[0] * recipe.repeat[1])));
            assert!((1..=256).contains(&recipe.layers.len()) && recipe.images.is_empty());
            for layer in recipe.layers {
                layer.pattern.checked().expect("was checked");
                layer.checked().expect("was checked");
            }
        }
        Err(error) => check(&error, bytes),
    }
    match paints::parse("recipe", bytes) {
        Ok(paints) => assert!(paints.own().all(|own| own.paint.clone().checked().is_ok())),
        Err(error) => check(&error, bytes),
    }
}

fn check(error: &RecipeError, bytes: &[u8]) {
    let lines = bytes.iter().filter(|byte| **byte == b'\n').count() + 1;
    assert!((1..=lines).contains(&error.line) && error.column > 0, "{error}");
    assert!(error.excerpt.ends_with('^') && error.excerpt.lines().count() == 3, "{error}");
    assert!(error.to_string().len() < 4096, "{error}");
}
