//! Which pseudo-random number belongs to an index?
//!
//! Studies draw random numbers as functions of an index, not from a running generator, so that any row can be made
//! alone, anywhere.
//!
//! # Source
//!
//! G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom number generators, OOPSLA 2014: the
//! mixing function of SplitMix64 and its odd increment.

/// The increment of SplitMix64, 2^64 over the golden ratio.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// All bits of a number stirred: a permutation of the 64-bit numbers.
pub fn mixed(number: u64) -> u64 {
    let mut z = number.wrapping_add(GOLDEN);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A number that distinguishes texts, except by intent: two texts with one number can be constructed.
pub fn of_text(text: &str) -> u64 {
    let start = mixed(text.len() as u64);
    text.as_bytes().chunks(8).fold(start, |hash, bytes| {
        let word = bytes.iter().fold(0, |word, byte| word << 8 | u64::from(*byte));
        mixed(hash ^ word).wrapping_add(GOLDEN)
    })
}

/// The number of a seed at a place with two coordinates.
pub fn of(seed: u64, a: u64, b: u64) -> u64 {
    mixed(mixed(mixed(seed) ^ a).wrapping_add(GOLDEN) ^ b)
}

/// The new place of `k` when the numbers below `count` are shuffled with that seed.
///
/// Four rounds of a Feistel network shuffle the numbers below the next power of four; a result beyond `count` is
/// shuffled again (M. Luby, C. Rackoff, SIAM Journal on Computing 17 (1988) 373; J. Black, P. Rogaway, Ciphers with
/// arbitrary finite domains, CT-RSA 2002).
pub fn shuffled(seed: u64, count: u64, k: u64) -> u64 {
    debug_assert!(k < count);
    let half = (64 - (count - 1).leading_zeros()).div_ceil(2);
    let mask = (1_u64 << half) - 1;
    let mut at = k;
    loop {
        for round in 0..4 {
            let (left, right) = (at >> half, at & mask);
            at = right << half | (left ^ of(seed, round, right) & mask);
        }
        if at < count {
            return at;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shuffle_is_a_permutation_and_another_for_each_seed() {
        for count in [1, 2, 3, 16, 17, 1000] {
            let order = |seed| (0..count).map(|k| shuffled(seed, count, k)).collect::<Vec<_>>();
            let mut sorted = order(1);
            assert!(count < 16 || order(1) != order(2), "{count}");
            sorted.sort_unstable();
            assert_eq!(sorted, (0..count).collect::<Vec<_>>());
        }
    }

    /// One bit of the input changes half of the output's.
    #[test]
    fn every_bit_stirs_every_other() {
        for bit in 0..64 {
            let turned: u32 = (0..256).map(|k| (mixed(k) ^ mixed(k ^ 1 << bit)).count_ones()).sum();
            assert!((31..34).contains(&(turned / 256)), "{bit} {turned}");
        }
    }
}
