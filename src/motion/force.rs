//! Which force in time acts on a bat?

/// Forces (N) at rising times (s).
#[derive(Debug, Clone, PartialEq)]
pub struct ForceHistory {
    /// Times (s).
    pub t: Vec<f64>,
    /// Forces (N).
    pub force: Vec<f64>,
}

impl ForceHistory {
    /// The straight stretches up to a time: the duration of each (s) and the force at its ends (N). The pauses before
    /// and after are stretches without force.
    pub fn until(&self, t: f64) -> Vec<(f64, [f64; 2])> {
        let mut stretches = vec![(self.t[0].min(t), [0.0; 2])];
        for k in 1..self.t.len() {
            let (from, to) = (self.t[k - 1], self.t[k]);
            if t <= from {
                break;
            }
            let force = [self.force[k - 1], self.force[k]];
            if t >= to {
                stretches.push((to - from, force));
            } else {
                let part = (t - from) / (to - from);
                stretches.push((t - from, [force[0], force[0] + part * (force[1] - force[0])]));
            }
        }
        stretches.push((t - self.t[self.t.len() - 1], [0.0; 2]));
        stretches.retain(|(length, _)| *length > 0.0);
        stretches
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_history_is_cut_where_it_is_asked() {
        let history = ForceHistory { t: vec![0.5, 1.0, 2.0], force: vec![4.0, 0.0, 8.0] };
        assert_eq!(history.until(0.25), [(0.25, [0.0; 2])]);
        assert_eq!(history.until(0.75), [(0.5, [0.0; 2]), (0.25, [4.0, 2.0])]);
        let all = [(0.5, [0.0; 2]), (0.5, [4.0, 0.0]), (1.0, [0.0, 8.0])];
        assert_eq!(history.until(2.0), all);
        assert_eq!(history.until(3.0)[..3], all);
        assert_eq!(history.until(3.0)[3], (1.0, [0.0; 2]));
        assert_eq!(history.until(0.0), []);
    }
}
