//! Where are the answers of a dialogue kept until it is finished?
//!
//! Beside the file that is to be written or, if there is none, in the user's folder for program state. If another file
//! is at that place (another dialogue's draft, or a file of the user), the draft gets the next number.

use std::env;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::own_file::{AtPath, OwnFile, look};

use crate::done::printable;
use crate::output::printed;

/// The first line of a draft, before its verb and [`GOES_ON`]. It distinguishes a draft from a user's file.
const ANSWERS_TO: &str = "# Answers to sweetspot ";
const GOES_ON: &str = ", which goes on after them\n";
/// The second line, before the bat's name, where that was no question.
const OF: &str = "# of: ";
/// The question about the bat's name.
pub const NAME: &str = "name";
/// How many places are tried.
const PLACES: usize = 9;

/// The answers of a draft.
#[derive(Default)]
pub struct Answers {
    /// The bat that they belong to; empty if no answer names it.
    pub of: String,
    /// Each answer after the name of its question.
    pub given: Vec<[String; 2]>,
}

/// The file of kept answers.
pub struct Draft {
    /// Its path without number and ending.
    stem: PathBuf,
    /// Number of its place; too large if no place is free.
    place: usize,
    /// Its first line.
    header: String,
    /// The bat that it belongs to; empty if an answer names it.
    of: String,
    /// The file, once it exists.
    file: Option<OwnFile>,
    /// The kind of the other file at the first place, if there is one.
    instead: Option<String>,
}

impl Draft {
    /// The draft of that verb about that bat, at a path without its ending, and its answers, if there are any.
    pub fn of((verb, stem): (&str, &Path), bat: &str) -> (Self, Option<Answers>) {
        let mut draft = Self {
            stem: stem.to_owned(),
            place: PLACES,
            header: format!("{ANSWERS_TO}{verb}{GOES_ON}"),
            of: printable(bat),
            file: None,
            instead: None,
        };
        for place in 0..PLACES {
            let path = draft.at(place);
            let name = printed(&path);
            let instead = match look(&path, &draft.header) {
                AtPath::Free => {
                    draft.place = draft.place.min(place);
                    continue;
                }
                AtPath::Held => format!("{name} is another dialogue's"),
                AtPath::Other => format!("{name} is another file"),
                AtPath::Own(file, text) => match read(&text[draft.header.len()..]) {
                    Some(found) if draft.is_of(&found) => {
                        (draft.place, draft.file) = (place, Some(file));
                        return (draft, Some(found));
                    }
                    Some(found) => format!("{name} is of another bat, '{}'", found.of),
                    None => format!("{name} is another file"),
                },
            };
            draft.instead = draft.instead.or(Some(instead));
        }
        (draft, None)
    }

    /// Whether answers may belong to this draft's bat.
    fn is_of(&self, found: &Answers) -> bool {
        self.of.is_empty() || found.of.is_empty() || found.of == self.of
    }

    fn at(&self, place: usize) -> PathBuf {
        let mut name = self.stem.as_os_str().to_owned();
        name.push(if place == 0 { String::new() } else { format!("-{}", place + 1) });
        name.push(".draft");
        name.into()
    }

    /// Its path, once it exists.
    pub fn path(&self) -> Option<&Path> {
        self.file.as_ref().map(OwnFile::path)
    }

    /// Describes where answers will be kept, and which file is in the way.
    pub fn said(&self) -> String {
        let before = self.instead.as_ref();
        let before = before.map_or(String::new(), |what| format!("{what}: it stays as it is. "));
        if self.place < PLACES {
            let name = printed(&self.at(self.place));
            format!("{before}Answers are kept in {name} until all is done.")
        } else {
            format!("{before}Nothing is kept.")
        }
    }

    /// Writes answers, or removes the draft if there are none; returns a message if it has moved.
    pub fn keep(&mut self, given: &[[String; 2]]) -> Option<String> {
        if given.is_empty() {
            if let Some(file) = self.file.take() {
                file.remove();
            }
            return None;
        }
        let of = if self.of.is_empty() { "" } else { &format!("{OF}{}\n", self.of) };
        let lines: String =
            given.iter().map(|[name, answer]| format!("{name}: {answer}\n")).collect();
        let text = format!("{}{of}{lines}", self.header);
        if let Some(file) = &mut self.file {
            match file.write(text.as_bytes()) {
                Err(error) if error.kind() == ErrorKind::AlreadyExists => self.file = None,
                // A folder that cannot be written to is reported at the end, with all answers.
                _ => return None,
            }
        }
        let first = self.place;
        while self.place < PLACES {
            match OwnFile::create(&self.at(self.place), text.as_bytes()) {
                Ok(file) => self.file = Some(file),
                // Another program was quicker.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                    self.place += 1;
                    continue;
                }
                Err(_) => {}
            }
            break;
        }
        (self.place > first).then(|| {
            self.instead = Some(format!("{} is another's now", printed(&self.at(first))));
            self.said()
        })
    }
}

/// The answers of a draft without its first line, each after the name of its question, and its bat; `None` for another
/// file.
fn read(text: &str) -> Option<Answers> {
    let of = text.lines().find_map(|line| line.strip_prefix(OF));
    let lines = text.lines().filter(|line| !line.starts_with(OF));
    let answer = |line: &str| line.split_once(':').map(|(a, b)| [a, b.trim()].map(str::to_owned));
    let given: Vec<[String; 2]> = lines.map(answer).collect::<Option<_>>()?;
    let named = given.iter().find(|[name, _]| name == NAME).map(|[_, name]| printable(name));
    let of = of.map(str::to_owned).or(named).unwrap_or_default();
    (!given.is_empty()).then_some(Answers { of, given })
}

/// The path, without ending, of a draft beside the file that is to be written, or with that name in the user's folder.
pub fn stem(beside: Option<&Path>, name: &str) -> PathBuf {
    match beside.filter(|file| file.as_os_str() != "-") {
        Some(file) => file.to_owned(),
        None => {
            own_folder().map_or_else(|| format!("sweetspot-{name}").into(), |own| own.join(name))
        }
    }
}

/// The user's folder for the state of this program; it is created if necessary.
///
/// # Source
///
/// XDG Base Directory Specification 0.8: `$XDG_STATE_HOME`, or `~/.local/state`; a relative path is ignored.
fn own_folder() -> Option<PathBuf> {
    let named = |name: &str| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let system = if cfg!(windows) { named("LOCALAPPDATA") } else { None };
    let state = named("XDG_STATE_HOME").or(system);
    let state = state.or_else(|| Some(named("HOME")?.join(".local").join("state")))?;
    let folder = state.join("sweetspot");
    let mut maker = std::fs::DirBuilder::new();
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut maker, 0o700);
    maker.recursive(true).create(&folder).ok()?;
    Some(folder)
}
