//! How bright a light of a container is: rated fluxes, equipment, emergencies, channels.

use super::{close, container, ies_flux_lm, kinds, ldt_flux_lm, only, read, refused};
use crate::container::{fixed, ies, ldt, simple, variant};
use quasilux_photometry::{DVec3, WarningKind};

#[test]
fn a_rated_flux_counts_before_that_of_the_file() {
    let rated = |lm: f64| format!("<RatedLuminousFlux>{lm}</RatedLuminousFlux>");
    // EULUMDAT has cd/klm, whether its lamps are counted or not.
    for count in [1, -1] {
        let bytes = simple("a.ldt", &ldt(count, 800.0), &rated(2000.0));
        let luminaire = read(&bytes, &[]);
        close(luminaire.photometry.flux_lm(), ldt_flux_lm(count, 800.0) * 2.5);
        close(luminaire.photometry.flux_lm(), 2000.0);
        let told = only(&luminaire.warnings, WarningKind::ContainerFlux);
        let of_file = if count > 0 { "lamps" } else { "candela" };
        let words = format!("2000 lm; expected 800.0 lm, as the {of_file} of ldc/a.ldt");
        assert!(told.contains(&words), "{told}");
        assert!(told.starts_with("product.xml:"), "{told}");
    }
    // Relative LM-63: for the lumens of its lamps.
    let luminaire = read(&simple("b.ies", &ies(2, 500.0), &rated(3000.0)), &[]);
    close(luminaire.photometry.flux_lm(), ies_flux_lm(2, 500.0) * 3.0);
    close(luminaire.photometry.rated_flux_lm().unwrap(), 3000.0);
    // Absolute photometry: the integral becomes the rated flux, as that of absolute EULUMDAT does.
    let luminaire = read(&simple("b.ies", &ies(1, -1.0), &rated(3000.0)), &[]);
    close(luminaire.photometry.flux_lm(), 3000.0);
    let told = only(&luminaire.warnings, WarningKind::ContainerFlux);
    assert!(told.contains("as the candela of ldc/b.ies have it (the container's"), "{told}");
    let dark = ies(1, -1.0).replace("300 250 0", "0 0 0").replace("300 1", "0 -1");
    let luminaire = read(&simple("b.ies", &dark.replace("300 100", "0 0"), &rated(3000.0)), &[]);
    assert!(luminaire.photometry.flux_lm().is_finite());
    // Fluxes that agree are not told, nor is one that is missing.
    for more in [rated(1000.0), String::new()] {
        let luminaire = read(&simple("a.ldt", &ldt(1, 1000.0), &more), &[]);
        close(luminaire.photometry.flux_lm(), 1000.0);
        assert_eq!(kinds(&luminaire), [], "{more}");
    }
    let luminaire = read(&simple("a.ldt", &ldt(1, 1000.0), &rated(0.0)), &[]);
    close(luminaire.photometry.flux_lm(), 1000.0);
    assert_eq!(kinds(&luminaire), [WarningKind::ContainerFlux]);
    refused(&simple("a.ldt", &ldt(1, 1000.0), &rated(-5.0)), &[]);
}

const EQUIPMENT: &str = "<LightSources><ChangeableLightSource id=\"lamp\"><Name><Locale \
    language=\"en\">T5</Locale></Name><RatedInputPower>14</RatedInputPower><RatedLuminousFlux>400\
    </RatedLuminousFlux></ChangeableLightSource></LightSources><Equipments><Equipment id=\"three\">\
    <LightSourceReference changeableLightSourceId=\"lamp\" lightSourceCount=\"3\"/>\
    <RatedInputPower>45</RatedInputPower><EmergencyBallastLumenFactor>0.25\
    </EmergencyBallastLumenFactor></Equipment>\
    </Equipments>";

#[test]
fn equipment_has_several_lamps_and_power_and_light_in_an_emergency() {
    let emitter = "<Emitters><Emitter id=\"e\"><ChangeableLightEmitter \
        emergencyBehaviour=\"Combined\"><PhotometryReference photometryId=\"b.ies\"/>\
        <EquipmentReference equipmentId=\"three\"/></ChangeableLightEmitter></Emitter></Emitters>";
    let bytes = container(&format!("{EQUIPMENT}{emitter}"), &variant("v", "e"));
    let luminaire = read(&bytes, &[]);
    close(luminaire.photometry.flux_lm(), ies_flux_lm(2, 500.0) * 1.2);
    assert_eq!(luminaire.photometry.facts().input_watts, 45.0);
    let source = luminaire.facts.iter().find(|fact| fact.name == "light source").unwrap();
    assert_eq!(source.value, "3 x T5");
    let emergency = read(&bytes, &["emergency"]);
    close(emergency.photometry.flux_lm(), 0.3 * ies_flux_lm(2, 500.0));
    // The power is that of normal operation.
    assert_eq!(emergency.photometry.facts().input_watts, 0.0);
    let power = emergency.facts.iter().find(|fact| fact.name == "power").unwrap();
    assert_eq!(power.value, "unknown of a part of the light");
}

#[test]
fn a_flux_in_an_emergency_is_that_of_the_light_source() {
    let more = "<RatedLuminousFlux>2000</RatedLuminousFlux><EmergencyRatedLuminousFlux>80\
        </EmergencyRatedLuminousFlux>";
    let lights = fixed("a.ldt", more, "emergencyBehaviour=\"EmergencyOnly\"");
    let emitters = format!("<Emitters><Emitter id=\"e\">{lights}</Emitter></Emitters>");
    let bytes = container(&emitters, &variant("v", "e"));
    let message = refused(&bytes, &[]);
    assert!(message.contains("emergency = true"), "{message}");
    let luminaire = read(&bytes, &["emergency"]);
    close(luminaire.photometry.flux_lm(), 80.0);
    // By name it shines as well, and that is told.
    let luminaire = read(&bytes, &["emitter=e"]);
    close(luminaire.photometry.flux_lm(), 80.0);
    assert!(kinds(&luminaire).contains(&WarningKind::EmergencyEmitter));
    let without = fixed("a.ldt", "", "emergencyBehaviour=\"Combined\"");
    let emitters = format!("<Emitters><Emitter id=\"e\">{without}</Emitter></Emitters>");
    let luminaire = read(&container(&emitters, &variant("v", "e")), &["emergency"]);
    close(luminaire.photometry.flux_lm(), 1000.0);
    assert_eq!(kinds(&luminaire), [WarningKind::EmergencyEmitter]);
    // The factor is one.
    let more = "<EmergencyBallastLumenFactor>1.5</EmergencyBallastLumenFactor>";
    let lights = fixed("a.ldt", more, "emergencyBehaviour=\"Combined\"");
    let emitters = format!("<Emitters><Emitter id=\"e\">{lights}</Emitter></Emitters>");
    refused(&container(&emitters, &variant("v", "e")), &["emergency"]);
}

fn channel(name: &str, file: &str, lm: f64) -> String {
    format!(
        "<Channel type=\"Fixed\"><DisplayName><Locale language=\"en\">{name}</Locale></DisplayName>\
         <PhotometryReference photometryId=\"{file}\"/><RatedLuminousFlux>{lm}\
         </RatedLuminousFlux></Channel>"
    )
}

fn with_channels(channels: &str) -> Vec<u8> {
    let definitions = format!(
        "<LightSources><MultiChannelLightSource id=\"m\"><RatedInputPower>40</RatedInputPower>\
         <Channels>{channels}</Channels></MultiChannelLightSource></LightSources><Emitters>\
         <Emitter id=\"e\"><MultiChannelLightEmitter>\
         <LightSourceReference multiChannelLightSourceId=\"m\"/>\
         </MultiChannelLightEmitter></Emitter></Emitters>"
    );
    container(&definitions, &variant("v", "e"))
}

fn channels() -> Vec<u8> {
    with_channels(&(channel("warm", "a.ldt", 1500.0) + &channel("cold", "b.ies", 2000.0)))
}

#[test]
fn channels_shine_together_or_one_by_one() {
    let bytes = channels();
    let [both, warm, cold] =
        [&[][..], &["channel=warm"], &["channel=2"]].map(|words| read(&bytes, words));
    close(warm.photometry.flux_lm(), 1500.0);
    close(cold.photometry.flux_lm(), 2.0 * ies_flux_lm(2, 500.0));
    // The tables have different angles; the sum is on all of them.
    let sum_lm = warm.photometry.flux_lm() + cold.photometry.flux_lm();
    close(both.photometry.flux_lm(), sum_lm);
    for direction in [DVec3::NEG_Z, DVec3::new(0.48, 0.36, -0.8), DVec3::new(0.0, 0.6, -0.8)] {
        let [sum, a, b] = [&both, &warm, &cold].map(|read| read.photometry.intensity_cd(direction));
        close(sum, a + b);
    }
    let told = only(&both.warnings, WarningKind::SeveralChannels);
    assert!(told.contains("2 channels: \"warm\", \"cold\""), "{told}");
    assert!(!kinds(&warm).contains(&WarningKind::SeveralChannels));
    let message = refused(&bytes, &["channel=blue"]);
    assert!(message.contains("expected one of \"warm\", \"cold\""), "{message}");
}

#[test]
fn a_channel_is_one_by_name_and_else_by_number() {
    let three = channel("2", "a.ldt", 100.0)
        + &channel("cold", "b.ies", 2000.0)
        + &channel("cold", "a.ldt", 300.0);
    let bytes = with_channels(&three);
    // The name counts before the number, and both are never added.
    close(read(&bytes, &["channel=2"]).photometry.flux_lm(), 100.0);
    close(read(&bytes, &["channel=3"]).photometry.flux_lm(), 300.0);
    assert!(refused(&bytes, &["channel=cold"]).contains("the channel \"cold\""));
    // One channel does not take the power of all.
    assert_eq!(read(&bytes, &["channel=3"]).photometry.facts().input_watts, 0.0);
    assert_eq!(read(&bytes, &[]).photometry.facts().input_watts, 40.0);
    // Where there are none, none can be chosen.
    let message = refused(&simple("a.ldt", &ldt(1, 1000.0), ""), &["channel=1"]);
    assert!(message.contains("the channel \"1\"; expected no \"channel\""), "{message}");
}

#[test]
fn a_channel_of_0_lm_is_dark() {
    let bytes = with_channels(&(channel("warm", "a.ldt", 1000.0) + &channel("off", "b.ies", 0.0)));
    let luminaire = read(&bytes, &[]);
    close(luminaire.photometry.flux_lm(), 1000.0);
    let told = only(&luminaire.warnings, WarningKind::ContainerFlux);
    assert!(told.contains("0 lm of \"off\""), "{told}");
    assert!(refused(&bytes, &["channel=off"]).contains("expected a channel that shines"));
}

#[test]
fn sums_of_channels_are_bounded() {
    // Planes and angles of their own in each channel: their union has 4000 x 1437 values.
    let file = |shift: f64| {
        let gamma: Vec<String> =
            (0..1001).map(|i| (f64::from(i) * 0.18 * (1.0 - shift) + shift).to_string()).collect();
        let plane = |i: i32| f64::from(i) + if i % 360 == 0 { 0.0 } else { shift };
        let planes: Vec<String> = (0..361).map(|i| plane(i).to_string()).collect();
        format!(
            "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 1001 361 1 2 0 0 0\n1 1 20\n{}\n{}\n{}",
            gamma.join(" "),
            planes.join(" "),
            "1 ".repeat(1001 * 361)
        )
    };
    let names = ["a.ies", "b.ies", "c.ies", "d.ies"];
    let channels: String = names.iter().map(|name| channel(name, name, 100.0)).collect();
    let definitions = format!(
        "{}<LightSources><MultiChannelLightSource id=\"m\"><Channels>{channels}</Channels>\
         </MultiChannelLightSource></LightSources><Emitters><Emitter id=\"e\">\
         <MultiChannelLightEmitter><LightSourceReference multiChannelLightSourceId=\"m\"/>\
         </MultiChannelLightEmitter></Emitter></Emitters>",
        crate::container::photometries(&names)
    );
    let product = crate::container::product(&definitions, &variant("v", "e"));
    let mut zip = crate::container::Zip::default().file("product.xml", product.as_bytes());
    for (i, name) in (0_u8..).zip(names) {
        zip = zip.file(&format!("ldc/{name}"), file(f64::from(i) * 0.001).as_bytes());
    }
    let message = refused(&zip.finish(), &[]);
    assert!(message.contains("emitters whose sum has"), "{message}");
}

#[test]
fn lamps_of_0_lm_have_the_flux_of_the_container() {
    for count in [1, -1] {
        let rated = "<RatedLuminousFlux>700</RatedLuminousFlux>";
        let luminaire = read(&simple("a.ldt", &ldt(count, 0.0), rated), &[]);
        close(luminaire.photometry.flux_lm(), 700.0);
        assert_eq!(kinds(&luminaire), [WarningKind::ZeroLampFlux], "{:?}", luminaire.warnings);
        let message = refused(&simple("a.ldt", &ldt(count, 0.0), ""), &[]);
        assert!(message.contains("ldc/a.ldt: found lamps of 0 lm, and no Rated"), "{message}");
    }
}

#[test]
fn tilt_factors_are_looked_for_in_the_container() {
    let file = ies(1, 1000.0).replace("TILT=NONE", "TILT=file.tlt");
    let product = crate::container::simple_product("b.ies", "");
    let zip = || {
        let zip = crate::container::Zip::default().file("product.xml", product.as_bytes());
        zip.file("ldc/b.ies", file.as_bytes())
    };
    assert_eq!(kinds(&read(&zip().finish(), &[])), [WarningKind::TiltFile]);
    let with = read(&zip().file("ldc/file.tlt", b"1\n3\n0 45 90\n1 0.5 0.25\n").finish(), &[]);
    assert_eq!(kinds(&with), []);
    close(with.photometry.tilt_factor(DVec3::X).factor, 0.25);
    let message = refused(&zip().file("ldc/file.tlt", b"9\n").finish(), &[]);
    assert!(message.starts_with("ldc/file.tlt:1:"), "{message}");
}
