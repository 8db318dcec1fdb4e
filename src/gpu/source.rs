//! WGSL sources and their one import mechanism.
//!
//! A line `#import NAME` is replaced by the text of the source of that name. Each source is joined once, in the order
//! in which it is first needed, so two files may import a third; a circle is an error that spells it out.

use super::LinkError;

/// One WGSL file, embedded in the binary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Source {
    /// Stem of the file, unique over all folders.
    pub name: &'static str,
    /// Path below the repository's root.
    pub path: &'static str,
    /// The file as written, import lines included.
    pub text: &'static str,
}

impl Source {
    /// The complete WGSL text: everything imported, directly or not, then this file.
    ///
    /// # Errors
    /// [`LinkError`] if a name is unknown or the imports form a circle.
    pub fn link(&self, library: &[Source]) -> Result<String, LinkError> {
        let mut linked = Linker { library, joined: Vec::new(), path: Vec::new(), text: String::new() };
        linked.join(self)?;
        Ok(linked.text)
    }

    /// Names that this file imports directly.
    pub fn imports(&self) -> impl Iterator<Item = &'static str> {
        self.text.lines().filter_map(|line| line.strip_prefix("#import ").map(str::trim))
    }
}

struct Linker<'a> {
    library: &'a [Source],
    joined: Vec<&'static str>,
    path: Vec<&'static str>,
    text: String,
}

impl Linker<'_> {
    fn join(&mut self, source: &Source) -> Result<(), LinkError> {
        if self.path.contains(&source.name) {
            let start = self.path.iter().position(|&name| name == source.name).unwrap_or(0);
            let mut circle = self.path[start..].to_vec();
            circle.push(source.name);
            return Err(LinkError::Cycle { path: circle.join(" -> ") });
        }
        if self.joined.contains(&source.name) {
            return Ok(());
        }
        self.path.push(source.name);
        for import in source.imports() {
            let found = self
                .library
                .iter()
                .find(|candidate| candidate.name == import)
                .ok_or_else(|| LinkError::UnknownImport { importer: source.name.to_owned(), import: import.to_owned() })?;
            self.join(found)?;
        }
        self.path.pop();
        self.joined.push(source.name);
        for line in source.text.lines().filter(|line| !line.starts_with("#import ")) {
            self.text.push_str(line);
            self.text.push('\n');
        }
        Ok(())
    }
}
