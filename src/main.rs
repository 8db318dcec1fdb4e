//! overpaint's command line.

fn main() {}
