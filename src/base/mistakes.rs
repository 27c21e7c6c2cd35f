//! All mistakes of a file in one run, instead of only the first.

use crate::base::error::{Error, FilePosition, Result};

/// Most mistakes that are shown; further ones are only counted.
const MOST: usize = 10;

/// The mistakes found so far.
///
/// A reader continues with a stand-in for a value that it could not read, so that the rest is checked too.
/// [`Self::end`] then makes sure that no result built from stand-ins is returned.
#[derive(Debug, Default)]
pub struct Mistakes {
    found: Vec<Error>,
    /// Number of mistakes that were only counted.
    more: usize,
}

impl Mistakes {
    /// Adds the mistake, or the mistakes, of an error.
    pub fn add(&mut self, error: Error) {
        match error {
            Error::Several { shown, more } => {
                self.found.extend(shown);
                self.more += more;
            }
            one => self.found.push(one),
        }
    }

    /// The value that was read; otherwise `None`, and the mistake is added.
    pub fn some<T>(&mut self, read: Result<T>) -> Option<T> {
        read.map_err(|error| self.add(error)).ok()
    }

    /// The value that was read; otherwise a stand-in, and the mistake is added.
    pub fn note<T: Default>(&mut self, read: Result<T>) -> T {
        self.some(read).unwrap_or_default()
    }

    /// The finished value, if there was no mistake.
    ///
    /// # Errors
    ///
    /// The mistakes in the order of the file, at most ten.
    pub fn end<T>(self, made: T) -> Result<T> {
        self.error().map_or(Ok(made), Err)
    }

    /// As [`Self::end`], for a value whose construction may fail too.
    pub fn and<T>(mut self, made: Result<T>) -> Result<T> {
        let made = made.map_err(|error| self.add(error));
        match (made, self.error()) {
            (Ok(made), None) => Ok(made),
            (_, error) => Err(error.expect("what was not made is a mistake too")),
        }
    }

    fn error(mut self) -> Option<Error> {
        if self.found.len() <= 1 && self.more == 0 {
            return self.found.pop();
        }
        let files = files(&self.found);
        self.found.sort_by_key(|error| {
            let place = place(error);
            let file = place.and_then(|place| files.iter().position(|file| *file == place.file));
            (file, place.map(|place| (place.line, place.column)))
        });
        self.more += self.found.len().saturating_sub(MOST);
        self.found.truncate(MOST);
        Some(Error::Several { shown: self.found, more: self.more })
    }
}

/// All of many values that were read; otherwise the first ten mistakes and the number of the others.
pub fn all<T>(read: impl IntoIterator<Item = Result<T>>) -> Result<Vec<T>> {
    let (mut right, mut mistakes) = (Vec::new(), Mistakes::default());
    for one in read {
        match one {
            Ok(value) => right.push(value),
            Err(error) if mistakes.found.len() < MOST => mistakes.add(error),
            Err(Error::Several { shown, more }) => mistakes.more += shown.len() + more,
            Err(_) => mistakes.more += 1,
        }
    }
    mistakes.end(right)
}

fn place(error: &Error) -> Option<&FilePosition> {
    match error {
        Error::Input { place, .. } => Some(place),
        _ => None,
    }
}

/// The files that contain mistakes, in the order in which they were read.
fn files(errors: &[Error]) -> Vec<String> {
    let mut files: Vec<String> = Vec::new();
    for place in errors.iter().filter_map(place) {
        if !files.contains(&place.file) {
            files.push(place.file.clone());
        }
    }
    files
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::error::{Complaint, Excerpt};

    fn at(file: &str, line: usize) -> Error {
        let excerpt = Excerpt::default();
        let place = Box::new(FilePosition { file: file.to_owned(), line, column: 1, excerpt });
        Error::Input { place, complaint: Complaint::new("", line, "none") }
    }

    #[test]
    fn mistakes_come_in_the_order_of_the_file_and_the_rest_is_counted() {
        let mut mistakes = Mistakes::default();
        assert_eq!(mistakes.note::<usize>(Ok(7)), 7);
        assert_eq!(mistakes.note::<usize>(Err(at("a", 3))), 0);
        assert_eq!(mistakes.some::<usize>(Err(at("b", 1))), None);
        mistakes.add(all((4..24).map(|line| Err::<(), _>(at("a", line)))).unwrap_err());
        mistakes.add(at("a", 2));
        let Err(Error::Several { shown, more }) = mistakes.end(()) else { panic!() };
        let lines: Vec<usize> = shown.iter().map(|error| place(error).unwrap().line).collect();
        assert_eq!((lines, more), ((2..12).collect(), 13));
    }

    #[test]
    fn one_mistake_is_itself_and_none_is_none() {
        let mut one = Mistakes::default();
        one.add(at("a", 3));
        assert_eq!(one.end(()).unwrap_err().to_string(), "a:3:1: found 3, expected none");
        assert_eq!(Mistakes::default().end(5).unwrap(), 5);
        assert_eq!(all([Ok(1), Ok(2)]).unwrap(), [1, 2]);
        let two = all([Ok(1), Err(at("a", 1)), Err(at("a", 2))]).unwrap_err();
        assert_eq!(two.to_string(), "a:1:1: found 1, expected none (and 1 more mistake)");
    }
}
