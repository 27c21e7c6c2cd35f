//! What in a study is unusual or without effect, although not a mistake?

use std::path::Path;

use crate::engine::{Bat, threads};
use crate::files::study_rows::{Rows, Varying};
use crate::files::study_vary::VariedFile;
use crate::many::design::{Axis, DesignRow};
use crate::many::rows::BatAnswers;

impl Rows {
    /// Warnings before the work: about the bats, as their files describe them and as the study varies them, about the
    /// scene, and about inputs without effect.
    pub fn warnings(&self) -> Vec<String> {
        /// Most bats with warnings.
        const TOLD: usize = 8;
        let own = |bat: &Varying| {
            let document = bat.document.as_ref().ok()?.to_string();
            Some(Bat::from_text(&bat.name, &document, Path::new("")).ok()?.warnings())
        };
        let varies = self.study.varies(VariedFile::Bat);
        let strange = self.bats.iter().enumerate().filter_map(|(k, bat)| {
            let own = own(bat).unwrap_or_default();
            let all = if own.is_empty() && varies && k < TOLD {
                self.first_strange(VariedFile::Bat, |row| {
                    Some(self.bat(bat, row).ok()?.warnings())
                })?
            } else {
                own.join("; ")
            };
            (!all.is_empty()).then(|| format!("{}: {all}", bat.name))
        });
        let mut told: Vec<String> = strange.collect();
        if told.len() > TOLD {
            let more = told.split_off(TOLD).len();
            told.push(format!("{more} more bats are strange in some way"));
        }
        told.extend(self.first_strange(VariedFile::Scene, |row| {
            let bat = self.bats.iter().find_map(|bat| self.bat(bat, row).ok());
            let strange = self.setup(row).ok()?.warnings(&bat).into_iter();
            Some(strange.map(|(member, strange)| format!("scene.{member} {strange}")).collect())
        }));
        told.extend(self.idle());
        let idle = &self.study.idle;
        told.extend((!idle.is_empty()).then(|| {
            format!("{} of the study: nothing is drawn, so that they do nothing", idle.join(", "))
        }));
        told
    }

    /// The warnings of `strange` about the median of all inputs, or else about another value of a list in that
    /// document, and which value.
    fn first_strange(
        &self,
        subject: VariedFile,
        strange: impl Fn(&DesignRow) -> Option<Vec<String>>,
    ) -> Option<String> {
        /// Most values of a list that are tried, and most characters of one that are quoted.
        const VALUES: u64 = 64;
        const TOLD: usize = 40;
        let design = &self.study.design;
        let middle = design.middle();
        let told =
            |row: &DesignRow| strange(row).filter(|all| !all.is_empty()).map(|all| all.join("; "));
        let lists =
            self.study.varied.iter().filter(|varied| {
                varied.subject == subject && matches!(varied.axis(), Axis::List(_))
            });
        let mut others = lists.flat_map(|varied| {
            let rows = design.beside(&middle, varied.axis(), VALUES).into_iter();
            rows.map(move |row| (varied, row))
        });
        told(&middle).or_else(|| {
            others.find_map(|(varied, row)| {
                let cell: String = varied.cell(&row).chars().take(TOLD).collect();
                Some(format!("{} (where {} is {cell})", told(&row)?, varied.path))
            })
        })
    }

    /// A warning about inputs that change no output of any bat by more than 1e-10 of it. Some values of some bats are
    /// tried, with everything else as in one row.
    fn idle(&self) -> Option<String> {
        /// Bats, combinations of lists, and rows that are tried; values of a list.
        const SOME: u64 = 4;
        const VALUES: u64 = 8;
        let bats = self.bats.iter().filter_map(|bat| Some((bat, bat.model.as_ref()?)));
        let bats: Vec<_> = bats.take(SOME as usize).collect();
        let varied = &self.study.varied;
        // The effect of one input may depend on another: the rows beside one are tried, and others of the design.
        let beside = |row: &DesignRow, k: usize| {
            let others = self.study.design.beside(row, varied[k].axis(), VALUES);
            std::iter::once(row.clone()).chain(others).collect::<Vec<_>>()
        };
        let idle = threads::map(varied.len(), |k| {
            // An unknown result counts as a change.
            let changes = |bat: &Varying, row: &DesignRow| {
                let of = beside(row, k);
                let found = self.answers_of_rows(bat, &of.iter().collect::<Vec<_>>());
                let known: Option<Vec<&BatAnswers>> =
                    found.iter().map(|one| one.as_ref().ok()).collect();
                let same =
                    |known: &[&BatAnswers]| known[1..].iter().all(|other| !other.differs(known[0]));
                of.len() == 1 || !known.is_some_and(|known| same(&known))
            };
            let examples = || self.study.design.examples(SOME);
            !bats.iter().any(|(bat, (row, _))| {
                changes(bat, row) || examples().any(|row| changes(bat, &row))
            })
        });
        let idle = varied.iter().zip(idle).filter(|(_, idle)| *idle);
        let paths: Vec<&str> = idle.map(|(varied, _)| &*varied.path).collect();
        (!paths.is_empty()).then(|| {
            format!(
                "nothing that is asked changes with {}: it does not depend on that, or something else in the \
                 bat, the ball or the scene stands for it",
                paths.join(", ")
            )
        })
    }
}
