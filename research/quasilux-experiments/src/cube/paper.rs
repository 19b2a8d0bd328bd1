//! What the paper prints: Voloboy, Dmitriev and Kopylov (2003), tables 4 and 5.

/// Luminances in cd/m^2 at the six classes of places, "theoretical" (table 4).
pub(super) const LUMINANCES_CD_M2: [f64; 6] = [892.8, 768.7, 686.6, 565.1, 522.4, 388.4];

/// The same by radiosity with analytic form factors and by a spectral solve, which agree to 0.003.
pub(super) const SOLVED_CD_M2: [f64; 6] = [892.80, 768.69, 686.70, 565.10, 522.41, 388.45];

/// Errors of one run after some time (table 5).
pub(super) struct Row {
    /// On a machine of 2003.
    pub(super) seconds: f64,
    /// In percent: pseudo, quasi, pseudo2 and quasi2.
    pub(super) errors_percent: [f64; 4],
    /// Pseudo over quasi, and the last column, which is pseudo over quasi2.
    pub(super) ratios: [f64; 2],
}

/// Table 5: s, pseudo, pseudo2, quasi, quasi2, and two ratios of errors. The paper heads the last
/// column as quasi2 against pseudo2; its figures are pseudo over quasi2.
const TABLE_5: &str = "\
10 45.9204 5.86363 12.4468 3.82236 3.689334 12.01363
20 16.5406 4.73141 9.41761 2.93786 1.756348 5.630153
40 10.6581 3.03132 6.07955 1.67198 1.753107 6.374538
80 7.62477 2.22926 4.65194 1.58217 1.639052 4.819185
160 4.94078 1.81915 3.32851 1.14765 1.484382 4.305128
320 3.76158 1.50558 2.46465 0.874162 1.526213 4.30307
640 3.39781 1.47235 2.06867 0.869336 1.642509 3.908512
1280 2.40313 1.29297 1.86245 0.859876 1.290306 2.79474
2560 2.06759 1.07941 1.73808 0.867626 1.189583 2.383043
5120 1.90293 1.01361 1.54866 0.806454 1.228759 2.359626
";

/// The rows of table 5.
pub(super) fn rows() -> Vec<Row> {
    let row = |line: &str| {
        let numbers: Vec<f64> =
            line.split(' ').map(|number| number.parse().expect("a number")).collect();
        let [seconds, pseudo, pseudo2, quasi, quasi2, first, last] = numbers[..] else {
            unreachable!("seven columns")
        };
        let errors_percent = [pseudo, quasi, pseudo2, quasi2];
        Row { seconds, errors_percent, ratios: [first, last] }
    };
    TABLE_5.lines().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_column_is_pseudo_over_quasi2() {
        for Row { errors_percent: [pseudo, quasi, _, quasi2], ratios, .. } in rows() {
            assert!((pseudo / quasi / ratios[0] - 1.0).abs() < 1e-5);
            assert!((pseudo / quasi2 / ratios[1] - 1.0).abs() < 1e-5);
        }
    }
}
