//! Tests of frequencies, shapes and related results in one program, which is built in a fraction of the time.

mod common;

mod accuracy;
mod batch;
mod convergence;
mod counted;
mod damped;
mod dowel;
mod extremes;
mod field;
mod formulas;
mod frf;
mod held;
mod invariances;
mod measured;
mod near_twins;
mod nodes;
mod over_stations;
mod promise;
mod sections;
mod solvers;
mod sound;
mod spread;
mod struck_string;
mod theories;
mod up_to;
mod validation;
