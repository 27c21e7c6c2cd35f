//! Can these fixtures be on a bat?

use crate::base::{Error, Mistakes, Result, mistakes};
use crate::bat::fixtures::{Attachment, Fixtures, Held, Region};
use crate::bat::part::{Part, SOFTEST};
use crate::bat::profile::{Profile, SAME_PLACE};

/// Frequencies closer than this, relative, count as equal.
const LEAST_GAP: f64 = 1e-9;

impl Fixtures {
    /// Checks that every value is possible on a bat of that profile.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] with the path of the key in a bat file as its field, or several of them.
    pub fn check(&self, profile: &Profile) -> Result<()> {
        let (length, mut mistakes) = (profile.length(), Mistakes::default());
        mistakes.note(each("regions", &self.regions, length));
        mistakes.note(each("attachments", &self.attachments, length));
        mistakes.note(each("tapes", &self.tapes, length));
        mistakes.note(each("absorbers", &self.absorbers, length));
        mistakes.note(each("joints", &self.joints, length));
        mistakes.note(each("supports", &self.supports, length));
        mistakes.note(self.grip.iter().try_for_each(|grip| grip.check("grip", length)));
        mistakes.end(())?;
        self.check_apart(length)?;
        self.check_points(profile)
    }

    /// Checks that nothing acts on a point of the bat, which would give way to any force without end.
    fn check_points(&self, profile: &Profile) -> Result<()> {
        let attached = self.attachments.iter().map(|on| ("attachments", on.x));
        let hung = self.absorbers.iter().map(|on| ("absorbers", on.x));
        let held = self.supports.iter().map(|on| ("supports", on.x));
        let point = |(_, x): &(_, f64)| profile.at(*x).outer == 0.0;
        let Some((list, x)) = attached.chain(hung).chain(held).find(point) else { return Ok(()) };
        let found = format!("one at {x} m, where the bat ends in a point");
        Err(Error::value(list, found, "another place, or a radius there: a point bears no force"))
    }

    /// Checks that fixtures which exclude each other are at different places.
    fn check_apart(&self, length: f64) -> Result<()> {
        let mut mistakes = Mistakes::default();
        let same = SAME_PLACE * length;
        for (k, region) in self.regions.iter().enumerate() {
            let overlap =
                |before: &&Region| before.from < region.to - same && region.from < before.to - same;
            if let Some(before) = self.regions[..k].iter().find(overlap) {
                let found = format!("{} to {} m, an overlap", region.from, region.to);
                let expected = format!("a stretch outside {} to {} m", before.from, before.to);
                mistakes.add(Error::value(format!("regions[{k}].from"), found, expected));
            }
        }
        let joints: Vec<f64> = self.joints.iter().map(|joint| joint.x).collect();
        let supports: Vec<f64> = self.supports.iter().map(|support| support.x).collect();
        for (list, name, places) in [("joints", "joint", joints), ("supports", "support", supports)]
        {
            for k in (1..places.len()).filter(|k| places[..*k].contains(&places[*k])) {
                let found = format!("{} m again", places[k]);
                let expected = format!("one {name} at one place");
                mistakes.add(Error::value(format!("{list}[{k}].x"), found, expected));
            }
        }
        mistakes.note(self.check_absorbers(same));
        mistakes.note(self.check_turning(same));
        mistakes.end(())
    }

    /// Absorbers at one place must differ in frequency: equal ones could ring against each other while the bat is at
    /// rest, which is not a mode of the bat.
    fn check_absorbers(&self, same: f64) -> Result<()> {
        let mut sorted: Vec<usize> = (0..self.absorbers.len()).collect();
        let tuning = |k: &usize| self.absorbers[*k].stiffness / self.absorbers[*k].mass;
        sorted.sort_by(|a, b| tuning(a).total_cmp(&tuning(b)));
        let alike = |a: &usize, b: &usize| {
            tuning(b) - tuning(a) <= 2.0 * LEAST_GAP * tuning(b)
                && (self.absorbers[*a].x - self.absorbers[*b].x).abs() <= same
        };
        let mut mistakes = Mistakes::default();
        for (i, k) in sorted.iter().enumerate() {
            let Some(other) = sorted[..i].iter().rev().find(|other| alike(other, k)) else {
                continue;
            };
            let [first, second] = [*k.min(other), *k.max(other)];
            let found = format!("the place and the frequency of absorbers[{first}]");
            let expected = "absorbers of other frequencies, or one with the masses, the springs and \
                            the dashpots added: alike they ring against each other, the bat at rest";
            mistakes.add(Error::value(format!("absorbers[{second}]"), found, expected));
        }
        mistakes.end(())
    }

    /// If only the distance of springs holds the bat against turning, it must be stiff enough to tell the motion from a
    /// rigid one.
    fn check_turning(&self, same: f64) -> Result<()> {
        let clamped = self.supports.iter().any(|support| support.kind == Held::Clamped)
            || self.attachments.iter().any(|a| a.rotational_stiffness > 0.0);
        let bed = self.grip.is_some_and(|grip| grip.stiffness > 0.0);
        let springs = || self.attachments.iter().filter(|a| a.stiffness > 0.0);
        let pin = self.supports.first().map(|support| support.x);
        if clamped || bed || self.supports.iter().any(|s| (s.x - pin.unwrap_or(s.x)).abs() > same) {
            return Ok(());
        }
        let whole: f64 = springs().map(|a| a.stiffness).sum();
        let middle = springs().map(|a| a.stiffness / whole * a.x).sum();
        let about = pin.unwrap_or(middle);
        let apart = |a: &&Attachment| (a.x - about).abs() > same;
        let turning: f64 =
            springs().filter(apart).map(|a| a.stiffness * (a.x - about).powi(2)).sum();
        let far = self.attachments.iter().position(|a| a.stiffness > 0.0 && apart(&a));
        let Some(k) = far.filter(|_| turning < SOFTEST) else { return Ok(()) };
        let found = format!("springs that hold the bat against turning by {turning:e} N m/rad");
        let expected =
            format!("{SOFTEST:e} N m/rad and more: springs farther apart, or all at one place");
        Err(Error::value(format!("attachments[{k}].x"), found, expected))
    }
}

/// Checks the parts of a list, on a bat of that length (m).
fn each<P: Part>(list: &str, parts: &[P], length: f64) -> Result<()> {
    let parts = parts.iter().enumerate();
    mistakes::all(parts.map(|(k, part)| part.check(&format!("{list}[{k}]"), length))).map(|_| ())
}
