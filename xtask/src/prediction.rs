//! Whether half-widths shrank as a run predicted: part of the check of every example.

use serde_json::Value;
use xtask::workspace::Failure;

/// Half-widths may on average be this many times the prediction of two checkpoints before, or one
/// over that.
const FACTOR: f64 = 1.5;

/// Checks `run.prediction` of a result document.
pub(crate) fn check(result: &Value) -> Result<(), Failure> {
    let prediction = &result["run"]["prediction"];
    let ratio = prediction["half_width_ratio"].as_f64().ok_or("no half-width was predicted")?;
    if (1.0 / FACTOR..=FACTOR).contains(&ratio) {
        return Ok(());
    }
    Err(format!(
        "half-widths are {ratio:.2} times the predicted ones, with a slope of {}",
        prediction["slope"]
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_prediction_off_by_more_than_the_factor_is_refused() {
        let document = |ratio: Value| json!({"run": {"prediction": {"slope": -0.7, "half_width_ratio": ratio}}});
        for good in [0.67, 1.0, 1.5] {
            assert_eq!(check(&document(json!(good))), Ok(()));
        }
        for bad in [json!(0.66), json!(1.51), Value::Null] {
            assert!(check(&document(bad)).is_err());
        }
    }
}
