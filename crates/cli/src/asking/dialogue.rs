//! How is a person asked, question by question? One may go back, or continue another day.
//!
//! A dialogue is a function of its answers. To go back means to drop the last answer and to start again, skipping the
//! questions with known answers. A draft is a file of the answers.

use std::collections::HashMap;
use std::io::{BufRead, Read as _, Write};
use std::path::Path;

use serde::Deserialize;
use sweetspot::base::error::Complaint;
use sweetspot::{Error, Result};
use sweetspot_report::parts::wrapped;

use crate::asking::draft::{Answers, Draft};
use crate::common::about;
use crate::done::printable;
use crate::output::printed;

/// A person gives up sooner, and a program that answers without end is stopped.
const MOST_TRIES: usize = 50;
/// The longest line that is read at once (bytes).
const LONGEST: u64 = 1 << 16;

/// The meaning of an answer, or why it is invalid.
pub type Read<T> = std::result::Result<T, Complaint>;

/// Why a question has no answer.
pub enum Halt {
    /// The person wants to answer the previous question again.
    Back,
    /// The person wants to leave; the answers are kept.
    Left,
    /// The answers have ended, or were wrong too often.
    Failed(Error),
}

impl From<Error> for Halt {
    fn from(error: Error) -> Self {
        Self::Failed(error)
    }
}

/// The answer to a question, or the reason why there is none.
pub type Asked<T> = std::result::Result<T, Halt>;

/// The questions of every verb, in their order; `@` stands for a unit.
const QUESTIONS: &str = include_str!("questions.json");

/// A question.
#[derive(Clone, Deserialize)]
pub struct Question {
    /// The key of its answer in a draft, equal to the name of the option with the same meaning.
    pub name: String,
    /// The question.
    pub text: String,
    /// The meaning of an empty line.
    pub usual: Option<String>,
    /// The reply to a question mark.
    pub help: String,
}

impl Question {
    /// The question of that name in the dialogue of a verb.
    pub fn named(verb: &str, name: &str) -> Self {
        let mut all: HashMap<String, Vec<Self>> =
            serde_json::from_str(QUESTIONS).expect("the file of the questions is whole");
        let own = all.remove(verb).into_iter().flatten().find(|question| question.name == name);
        own.expect("the file has every question")
    }

    /// The question about a value in that unit.
    pub fn of(self, unit: &str) -> Self {
        Self { text: self.text.replace('@', unit), ..self }
    }
}

/// A dialogue with a person who answers line by line; questions go to standard error.
pub struct Dialogue<R> {
    /// `None` if there is no person to ask.
    answers: Option<R>,
    /// Valid answers, each after the name of its question.
    given: Vec<[String; 2]>,
    /// Number of them that were reused since the start.
    passed: usize,
    draft: Option<Draft>,
    /// An earlier draft, until the person decides whether to continue it.
    before: Option<Answers>,
}

/// Words that leave a dialogue.
const LEAVING: [&str; 3] = ["quit", "exit", "q"];

impl<R: BufRead> Dialogue<R> {
    /// A dialogue without a draft.
    #[cfg(test)]
    pub fn new(answers: R) -> Self {
        Self { answers: Some(answers), ..Self::nobody() }
    }

    /// A dialogue without a person: every question gets its default answer, if it has one.
    pub fn nobody() -> Self {
        Self { answers: None, given: vec![], passed: 0, draft: None, before: None }
    }

    /// Whether there is a person to ask.
    pub fn is_there(&self) -> bool {
        self.answers.is_some()
    }

    /// A dialogue about that bat, which may not have a name yet, with a draft. If there is a draft of this bat,
    /// [`Self::hold`] asks whether to continue it.
    pub fn kept(answers: R, draft: (&str, &Path), of: &str) -> Self {
        let (draft, before) = Draft::of(draft, of);
        let answers = Some(answers);
        let dialogue = Self { answers, draft: Some(draft), before, ..Self::nobody() };
        if let (Some(draft), None) = (&dialogue.draft, &dialogue.before) {
            dialogue.tell(&draft.said());
        }
        dialogue
    }

    /// Asks until there is a result; each time the person goes back it starts again. `None` if the person leaves
    /// before. It first asks about an earlier draft.
    ///
    /// # Errors
    ///
    /// As [`Self::ask`].
    pub fn hold<T>(&mut self, dialogue: impl Fn(&mut Self) -> Asked<T>) -> Result<Option<T>> {
        match self.resume() {
            Ok(()) => {}
            Err(Halt::Failed(error)) => return Err(error),
            Err(Halt::Back | Halt::Left) => return Ok(self.left()),
        }
        loop {
            self.passed = 0;
            match dialogue(self) {
                Ok(result) => return Ok(Some(result)),
                Err(Halt::Failed(error)) => return Err(error),
                Err(Halt::Left) => return Ok(self.left()),
                Err(Halt::Back) => {}
            }
        }
    }

    /// Asks whether to continue an earlier draft, by the name of its bat.
    fn resume(&mut self) -> Asked<()> {
        let Some(before) = self.before.take() else { return Ok(()) };
        let draft = self.kept_in().unwrap_or_default();
        let of = if before.of.is_empty() { "a bat without a name" } else { &before.of };
        let count = before.given.len();
        let answers = if count == 1 { "answer" } else { "answers" };
        let text =
            format!("Go on with the draft of '{of}' ({count} {answers} in {draft}), yes or no");
        let question = Question { text, ..Question::named("draft", "go on") };
        if self.answered(&question, yes_or_no)?.1 {
            self.given = before.given;
            self.tell(&format!("Going on after the {count} {answers} in {draft}."));
        }
        Ok(())
    }

    /// Says where the answers are kept when the person has left.
    fn left<T>(&self) -> Option<T> {
        self.tell(&match self.kept_in() {
            Some(draft) => format!(
                "Left, and nothing is written. The answers are kept in {draft}; the same command asks whether to \
                 go on with them."
            ),
            None => "Left, and nothing is written.".to_owned(),
        });
        None
    }

    /// Removes the draft when its purpose is fulfilled.
    pub fn done(&mut self) {
        self.given.clear();
        self.keep();
    }

    /// Prints a line that asks nothing, unless it was printed before the known answers.
    pub fn say(&self, text: &str) {
        if self.is_there() && self.passed == self.given.len() {
            self.tell(text);
        }
    }

    fn tell(&self, text: &str) {
        let lines: Vec<String> = wrapped(text, 2).trim_end().split('\n').map(printable).collect();
        // Without standard error the questions are not seen; but answers may still come.
        let _ = writeln!(std::io::stderr(), "{}", lines.join("\n"));
    }

    /// The place of the kept answers, if there are any.
    fn kept_in(&self) -> Option<String> {
        self.draft.as_ref().and_then(Draft::path).map(printed)
    }

    /// The value of an option, or else the answer to the question of its name.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] about the option; as [`Self::ask`].
    pub fn told<T>(
        &mut self,
        option: &Option<String>,
        question: &Question,
        read: impl Fn(&str) -> Read<T>,
    ) -> Asked<T> {
        let Some(text) = option else { return self.ask(question, read) };
        Ok(read(text).map_err(|complaint| about(format!("--{}", question.name), complaint))?)
    }

    /// Asks until the answer is valid.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] at the end of the answers, after too many wrong ones, or if there is no person to answer.
    pub fn ask<T>(&mut self, question: &Question, read: impl Fn(&str) -> Read<T>) -> Asked<T> {
        if !self.is_there() {
            let usual = question.usual.as_deref();
            let usual = usual.ok_or_else(|| missing(&format!("--{}", question.name)))?;
            return Ok(read(usual).map_err(Error::Value)?);
        }
        if let Some(value) = self.known(question, &read) {
            return Ok(value);
        }
        let (answer, value) = self.answered(question, read)?;
        self.given.push([question.name.to_owned(), answer]);
        self.passed += 1;
        self.keep();
        Ok(value)
    }

    /// An answer as typed, and its meaning.
    fn answered<T>(
        &mut self,
        question: &Question,
        read: impl Fn(&str) -> Read<T>,
    ) -> Asked<(String, T)> {
        for _ in 0..MOST_TRIES {
            let line = match self.line(question)? {
                Ok(line) => line,
                Err(complaint) => {
                    self.tell(&format!("  {complaint}"));
                    continue;
                }
            };
            let answer =
                if line.is_empty() { question.usual.as_deref().unwrap_or("") } else { &line };
            match (answer, read(answer)) {
                ("?", _) => self.tell(&format!("  {}", question.help)),
                ("back", _) if self.given.is_empty() => self.tell("  This is the first question."),
                ("back", _) => {
                    self.given.pop();
                    self.keep();
                    return Err(Halt::Back);
                }
                (word, _) if LEAVING.contains(&word.to_lowercase().as_str()) => {
                    return Err(Halt::Left);
                }
                (_, Ok(value)) => return Ok((answer.to_owned(), value)),
                (_, Err(complaint)) => self.tell(&format!("  {complaint}")),
            }
        }
        let found = format!("{MOST_TRIES} wrong answers, one after the other");
        Err(self.ended(question, &found))
    }

    /// The earlier answer to this question. Answers to other questions in its place are forgotten.
    fn known<T>(&mut self, question: &Question, read: impl Fn(&str) -> Read<T>) -> Option<T> {
        let [name, answer] = self.given.get(self.passed)?;
        let value = if *name == question.name { read(answer).ok() } else { None };
        match value {
            Some(_) => self.passed += 1,
            None => self.given.truncate(self.passed),
        }
        value
    }

    /// The next line, without blanks around it, or why it is not a text.
    fn line(&mut self, question: &Question) -> Asked<Read<String>> {
        let hint = question.usual.as_deref().filter(|usual| !usual.is_empty());
        let hint = hint.map_or(String::new(), |usual| format!(" [{usual}]"));
        let text: Vec<String> = question.text.split('\n').map(printable).collect();
        let _ = write!(std::io::stderr(), "{}{}: ", text.join("\n"), printable(&hint));
        let mut line = vec![];
        let failed = |source| Error::Read { path: "standard input".into(), source };
        let answers = self.answers.as_mut();
        let read = answers.map(|answers| answers.take(LONGEST).read_until(b'\n', &mut line));
        if read.transpose().map_err(failed)?.unwrap_or(0) == 0 {
            let _ = writeln!(std::io::stderr());
            return Err(self.ended(question, "the end of the answers"));
        }
        Ok(match String::from_utf8(line) {
            Ok(line) => Ok(line.trim().to_owned()),
            Err(_) => {
                let expected = "UTF-8: type it without accents, or set the terminal to UTF-8";
                Err(Complaint::new("", "letters in another encoding than UTF-8", expected))
            }
        })
    }

    fn ended(&self, question: &Question, found: &str) -> Halt {
        let kept = self.kept_in().map_or("nothing was written".to_owned(), |draft| {
            format!("the others are kept in {draft}, and the same command asks whether to go on with them")
        });
        Halt::Failed(Error::value(question.text.trim(), found, format!("an answer; {kept}")))
    }

    /// Writes the draft, or removes it if it would be empty.
    fn keep(&mut self) {
        let moved = self.draft.as_mut().and_then(|draft| draft.keep(&self.given));
        if let Some(said) = moved {
            self.tell(&said);
        }
    }
}

/// The error about a missing answer.
pub fn missing(what: &str) -> Error {
    Error::value("new", "none", format!("{what}, or --ask to answer questions"))
}

fn yes_or_no(text: &str) -> Read<bool> {
    match text.to_lowercase().as_str() {
        "y" | "yes" => Ok(true),
        "n" | "no" => Ok(false),
        _ => Err(Complaint::new("", format!("\"{text}\""), "yes or no")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asking::ask::mass;

    fn weight() -> Question {
        Question { usual: None, ..Question::named("calibrate", "mass") }
    }

    #[test]
    fn a_wrong_answer_is_asked_again_and_the_end_of_answers_is_an_error() {
        let mut dialogue = Dialogue::new("31\nheavy\n?\nback\n31.5 oz\n".as_bytes());
        let mass = |dialogue: &mut Dialogue<&[u8]>| dialogue.ask(&weight(), mass);
        assert_eq!(dialogue.hold(mass).unwrap().unwrap().as_deref(), Some("31.5 oz"));
        let two = |dialogue: &mut Dialogue<&[u8]>| mass(dialogue).and_then(|_| mass(dialogue));
        assert!(dialogue.hold(two).is_err());
    }

    #[test]
    fn who_quits_is_asked_nothing_more() {
        for word in ["quit", "exit", "q", "Quit"] {
            let answers = format!("30 oz\n{word}\n31 oz\n");
            let mut dialogue = Dialogue::new(answers.as_bytes());
            let two = |dialogue: &mut Dialogue<&[u8]>| -> Asked<_> {
                Ok([dialogue.ask(&weight(), mass)?, dialogue.ask(&weight(), mass)?])
            };
            assert!(dialogue.hold(two).unwrap().is_none(), "{word}");
        }
    }

    #[test]
    fn who_goes_back_answers_the_question_before_anew() {
        let mut dialogue = Dialogue::new("30 oz\n31 oz\nback\nback\n32 oz\n33 oz\n".as_bytes());
        let two = |dialogue: &mut Dialogue<&[u8]>| -> Asked<_> {
            Ok([dialogue.ask(&weight(), mass)?, dialogue.ask(&weight(), mass)?])
        };
        let three = |dialogue: &mut Dialogue<&[u8]>| {
            let both = two(dialogue)?;
            if dialogue.given.len() == 2 && both[0].as_deref() == Some("30 oz") {
                dialogue.ask(&weight(), mass)?;
            }
            Ok(both)
        };
        let found = dialogue.hold(three).unwrap().unwrap();
        assert_eq!(found.map(Option::unwrap), ["32 oz", "33 oz"]);
    }
}
