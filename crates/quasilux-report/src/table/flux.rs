//! Where the light went, in one line.

use crate::Run;
use crate::number::brief;

/// Shares of the emitted flux that surfaces took, that left the scene, and that `max_bounces` cut;
/// `None` where no photon was traced.
pub(super) fn flux(run: &Run) -> Option<String> {
    let flux = &run.flux;
    if !(flux.emitted_lm > 0.0 && flux.emitted_lm.is_finite()) {
        return None;
    }
    let share = |part_lm: f64| format!("{} %", brief(100.0 * part_lm / flux.emitted_lm, 3));
    let cut = match run.settings.max_bounces {
        Some(bounces) => format!(", {} cut after {bounces} bounces", share(flux.cut_lm)),
        None => String::new(),
    };
    Some(format!(
        "light: {} lm, {} absorbed, {} left the scene{cut}",
        brief(flux.emitted_lm, 4),
        share(flux.absorbed_lm),
        share(flux.lost_lm)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;
    use quasilux_transport::FluxBalance;

    #[test]
    fn shares_are_of_what_is_emitted() {
        let mut run = example::office().run;
        run.flux =
            FluxBalance { emitted_lm: 8000.0, absorbed_lm: 6000.0, lost_lm: 1500.0, cut_lm: 500.0 };
        let line = flux(&run).unwrap();
        assert_eq!(line, "light: 8000 lm, 75 % absorbed, 18.8 % left the scene");
        run.settings.max_bounces = Some(3);
        let line = flux(&run).unwrap();
        assert!(line.ends_with("18.8 % left the scene, 6.25 % cut after 3 bounces"), "{line}");
        run.flux = FluxBalance::default();
        assert_eq!(flux(&run), None);
    }
}
