//! The chapters, and which tests an error is shown to by its place.

use std::path::{Path, PathBuf};

use crate::Result;

/// `chapters.txt`.
pub struct Chapters {
    rows: Vec<(String, Vec<String>)>,
    /// Tests that never run here, by a part of their names.
    pub without: Vec<String>,
}

impl Chapters {
    /// A row of the text is the beginning of a path and the names of tests, or `without` and names.
    pub fn read(path: &Path) -> Result<Chapters> {
        let text = std::fs::read_to_string(path)?;
        let mut chapters = Chapters { rows: vec![], without: vec![] };
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let mut words = line.split_whitespace().map(str::to_owned);
            let Some(first) = words.next() else { continue };
            match first.as_str() {
                "without" => chapters.without.extend(words),
                _ => chapters.rows.push((first, words.collect())),
            }
        }
        Ok(chapters)
    }

    /// The folders of the chapters: the rows whose path ends with `/`.
    pub fn folders(&self) -> Vec<PathBuf> {
        let folders = self.rows.iter().filter_map(|(path, _)| path.strip_suffix('/'));
        let mut folders: Vec<PathBuf> = folders.map(PathBuf::from).collect();
        // A chapter may have several rows, one after the other.
        folders.dedup();
        folders
    }

    /// The chapter of a file.
    pub fn of<'a>(&'a self, file: &str) -> &'a str {
        let mut paths = self.rows.iter().map(|(path, _)| path);
        let chapter = paths.find(|path| path.ends_with('/') && file.starts_with(path.as_str()));
        chapter.map_or("", |path| path)
    }

    /// The tests of a file: those of every row whose path it begins with, the rows of the longest path first.
    pub fn tests(&self, file: &Path) -> Vec<&str> {
        let file = file.to_string_lossy();
        let mut rows: Vec<_> =
            self.rows.iter().filter(|(path, _)| file.starts_with(path.as_str())).collect();
        rows.sort_by_key(|(path, _)| usize::MAX - path.len());
        let mut tests: Vec<&str> = Vec::new();
        for test in rows.into_iter().flat_map(|(_, tests)| tests) {
            if !tests.contains(&test.as_str()) {
                tests.push(test);
            }
        }
        tests
    }

    /// The names of all test programs of `tests/`; the others are beside the code.
    pub fn programs(&self) -> Vec<&str> {
        let beside = |name: &str| {
            ["main", "sweetspot", "uff58"].contains(&name) || name.starts_with("sweetspot_")
        };
        let tests = self.rows.iter().flat_map(|(_, tests)| tests);
        let mut programs: Vec<_> =
            tests.map(|test| test.split(':').next().unwrap_or(test)).collect();
        programs.retain(|name| !beside(name));
        programs.sort();
        programs.dedup();
        programs
    }
}
