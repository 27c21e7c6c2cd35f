//! A model of a bat: a theory and a set of parts, solved once for all questions.

use std::rc::Rc;

use serde::Serialize;

use crate::advise::part::ModelPart;
use crate::engine::{Bat, Error, Inertia, Request, Result, Solution, Theory, solve};

/// The parts of a bat in a model.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Model {
    /// Beam theory.
    #[schemars(with = "String", extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: Theory,
    /// The parts in addition to the bare bat, in words.
    // In the order of [`ModelPart::ALL`].
    #[schemars(with = "Vec<String>")]
    pub parts: Vec<ModelPart>,
}

impl Model {
    /// Everything that is known about the bat, with shear if it is known.
    pub fn full(bat: &Bat) -> Self {
        let theory = if bat.knows_shear() { Theory::Timoshenko } else { Theory::Rayleigh };
        let parts = ModelPart::ALL.into_iter().filter(|part| part.is_on(bat)).collect();
        Self { theory, parts }
    }

    /// This model without some parts.
    pub fn without(&self, parts: &[ModelPart]) -> Self {
        let kept = self.parts.iter().copied().filter(|part| !parts.contains(part));
        Self { theory: self.theory, parts: kept.collect() }
    }

    /// This model with another theory.
    pub fn by(&self, theory: Theory) -> Self {
        Self { theory, ..self.clone() }
    }

    /// Number of switches that are on: rotary inertia, shear, and one for each kind of part.
    pub fn size(&self) -> usize {
        usize::from(self.theory.turns()) + usize::from(self.theory.shears()) + self.parts.len()
    }

    /// The bat of this model.
    ///
    /// # Errors
    ///
    /// If the remaining bat cannot be solved: without its supports it may hang on springs that are too weak.
    pub fn bat(&self, bat: &Bat) -> Result<Bat> {
        let missing = ModelPart::ALL.into_iter().filter(|part| !self.parts.contains(part));
        let missing: Vec<ModelPart> = missing.filter(|part| part.is_on(bat)).collect();
        let left =
            bat.with(|parts| missing.iter().for_each(|part| part.take_off(&mut parts.fixtures)));
        let names: Vec<&str> = missing.iter().map(|part| part.name()).collect();
        let hint = format!("that is the bat without {}", names.join(", "));
        left.map_err(|error| error.placed(|found| Error::Value(found.hinted(hint.clone()))))
    }
}

/// A model and its modes.
#[derive(Debug, Clone, Serialize, schemars::JsonSchema)]
pub struct Solved {
    /// The model: a theory and the parts of the bat it includes.
    #[serde(flatten)]
    pub model: Model,
    /// How many motions are rigid, at 0 Hz.
    pub rigid_modes: usize,
    /// Frequency of each mode (Hz).
    pub frequencies_hz: Vec<f64>,
    /// Relative error of each frequency.
    pub error_by_mode: Vec<f64>,
    /// The bat with the parts of the model.
    #[serde(skip)]
    pub bat: Bat,
    /// Modes of the model.
    #[serde(skip)]
    pub solution: Solution,
}

impl Solved {
    /// A bat, solved by a theory.
    ///
    /// # Errors
    ///
    /// Those of [`solve`].
    pub fn new(model: Model, bat: Bat, request: &Request) -> Result<Self> {
        let solution = solve(&bat, &Request { theory: model.theory, ..*request })?;
        Ok(Self {
            model,
            rigid_modes: solution.rigid_modes,
            frequencies_hz: solution.modes.iter().map(|mode| mode.frequency()).collect(),
            error_by_mode: solution.modes.iter().map(|mode| mode.error.total()).collect(),
            bat,
            solution,
        })
    }

    /// Its inertia as a rigid body: a line of mass without rotary inertia.
    pub fn inertia(&self) -> Inertia {
        let body = self.bat.inertia();
        if self.model.theory.turns() { body } else { body.as_line() }
    }

    /// Whether mode k of one model corresponds to mode k of the other if a part is added gradually.
    ///
    /// Frequencies in their order change continuously then, but only together with the rigid motions at 0 Hz: with an
    /// equal number of these the orders agree. An absorber adds a mode; below its own frequency it acts as a weight,
    /// and the orders agree there.
    pub fn pairs_with(&self, that: &Self) -> bool {
        let highest = |solved: &Self| solved.solution.modes.last().map_or(0.0, |mode| mode.omega);
        let top = f64::max(highest(self), highest(that));
        let [few, many] = match (&self.bat.fixtures().absorbers, &that.bat.fixtures().absorbers) {
            (a, b) if a.len() < b.len() => [a, b],
            (a, b) => [b, a],
        };
        let slow = many.iter().any(|a| (a.stiffness / a.mass).sqrt() <= top);
        let added = many.len() > few.len() && slow;
        self.rigid_modes == that.rigid_modes && !added
    }
}

/// The models of one bat that have been solved.
#[derive(Debug)]
pub struct Bench<'a> {
    /// The bat with everything on it.
    pub bat: &'a Bat,
    request: Request,
    solved: Vec<Rc<Solved>>,
}

impl<'a> Bench<'a> {
    /// For the given number of modes, with every frequency to that tolerance.
    pub fn new(bat: &'a Bat, modes: usize, tolerance: f64) -> Self {
        let request = Request { modes, tolerance, ..Request::plain() };
        Self { bat, request, solved: Vec::new() }
    }

    /// The modes of a model.
    ///
    /// # Errors
    ///
    /// Those of [`solve`].
    pub fn solve(&mut self, model: &Model) -> Result<Rc<Solved>> {
        if let Some(known) = self.solved.iter().find(|known| known.model == *model) {
            return Ok(Rc::clone(known));
        }
        let solved = Rc::new(Solved::new(model.clone(), model.bat(self.bat)?, &self.request)?);
        self.solved.push(Rc::clone(&solved));
        Ok(solved)
    }

    /// The modes of another bat in place of a model's; not stored.
    ///
    /// # Errors
    ///
    /// Those of [`solve`].
    pub fn solve_instead(&self, model: &Model, bat: Bat) -> Result<Solved> {
        Solved::new(model.clone(), bat, &self.request)
    }
}
