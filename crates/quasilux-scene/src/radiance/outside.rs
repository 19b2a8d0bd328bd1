//! Light from outside: `source` surfaces that are the sun, the sky or the ground.

use super::definitions::Definition;
use super::findings::Findings;
use super::generators::FILE_OF_GENDAYLIT;
use super::look::luminance_cd_m2;
use super::xform::{Parsed, Transforms};
use glam::{DMat3, DVec3};
use std::f64::consts::PI;

/// Sun, sky and ground.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outside {
    pub(crate) sky: Option<SkyKind>,
    /// Where the sun is by the sky's model.
    pub(crate) sky_sun: Option<DVec3>,
    pub(crate) sun: Option<Sun>,
    pub(crate) ground: Option<Ground>,
}

/// A disk that shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sun {
    /// Of length 1.
    pub(crate) direction: DVec3,
    pub(crate) normal_illuminance_lx: f64,
}

/// Model of a sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SkyKind {
    Uniform {
        luminance_cd_m2: f64,
    },
    /// A CIE sky of this number.
    Cie {
        number: u8,
        zenith_cd_m2: f64,
    },
    Perez {
        direct_normal_w_m2: f64,
        diffuse_horizontal_w_m2: f64,
        has_sun: bool,
    },
}

/// The ground around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Ground {
    Luminance(f64),
    Reflectance(f64),
}

/// Sources of less than this full angle in degrees are suns.
const SUN_DEG: f64 = 10.0;
/// Sources of more than this are hemispheres.
const HEMISPHERE_DEG: f64 = 170.0;

/// A source with its material, and patterns of it.
pub(super) struct Far<'d> {
    pub(super) direction: DVec3,
    pub(super) angle_deg: f64,
    pub(super) material: &'d Definition,
    pub(super) patterns: Vec<&'d Definition>,
    pub(super) place: String,
}

/// A pattern of a sky, by the numbers of its file of functions.
enum Model {
    Plain,
    Skybright { number: u8, zenith: f64, ground: f64, sun: Option<DVec3> },
    Gendaylit { irradiances: [f64; 2], sun: DVec3, has_sun: bool, ground_reflectance: f64 },
}

impl Outside {
    /// Takes a source.
    pub(super) fn add(&mut self, far: &Far<'_>, findings: &mut Findings) {
        let mut note = |message: &str| findings.note(&far.place, message);
        let radiance: Option<[f64; 3]> = far.material.primitive.reals.first_chunk().copied();
        let is_fine = |it: &[f64; 3]| it.iter().all(|channel| (0.0..=1e12).contains(channel));
        let kind = &*far.material.primitive.kind;
        let Some(radiance) = radiance.filter(is_fine).filter(|_| super::materials::shines(kind))
        else {
            return note("a source whose material does not shine is left out");
        };
        if radiance.iter().any(|&channel| channel != radiance[0]) {
            note("the colour of its light is left out");
        }
        let luminance = luminance_cd_m2(radiance);
        let is_below = far.direction.z < 0.0;
        if far.angle_deg < SUN_DEG {
            self.add_sun(far, luminance, &mut note);
        } else if far.angle_deg < HEMISPHERE_DEG {
            note("a source of an angle between those of a sun and of a sky is left out");
        } else if far.direction.z.abs() < 0.999 {
            note("a sky that is not upright is left out");
        } else {
            match Model::from_patterns(&far.patterns) {
                Err(what) => note(what),
                Ok(model) => {
                    let is_all = far.angle_deg > 360.0 - HEMISPHERE_DEG + 10.0;
                    if !is_below || is_all {
                        self.add_sky(&model, luminance, &mut note);
                    }
                    if is_below || is_all {
                        self.ground = Some(model.ground(luminance));
                    }
                }
            }
        }
    }

    fn add_sun(&mut self, far: &Far<'_>, luminance: f64, note: &mut dyn FnMut(&str)) {
        if !far.patterns.is_empty() {
            note("the pattern of a sun is left out");
        }
        let solid_angle = 2.0 * PI * (1.0 - libm::cos((0.5 * far.angle_deg).to_radians()));
        let sun = Sun { direction: far.direction, normal_illuminance_lx: luminance * solid_angle };
        if far.direction.z <= 0.0 {
            note("a sun below the horizon is left out");
        } else if sun.normal_illuminance_lx <= 0.0 {
            note("a sun that gives no light is left out");
        } else if self.sun.is_some() {
            note("there is another sun before: this one is left out");
        } else {
            self.sun = Some(sun);
        }
    }

    fn add_sky(&mut self, model: &Model, luminance: f64, note: &mut dyn FnMut(&str)) {
        if self.sky.is_some() {
            return note("there is another sky before: this one is left out");
        }
        self.sky = Some(match *model {
            Model::Plain => SkyKind::Uniform { luminance_cd_m2: luminance },
            Model::Skybright { number, zenith, sun, .. } => {
                self.sky_sun = sun;
                let zenith_cd_m2 = luminance * zenith;
                match number {
                    1 => SkyKind::Cie { number: 12, zenith_cd_m2 },
                    2 => SkyKind::Cie { number: 16, zenith_cd_m2 },
                    _ => SkyKind::Uniform { luminance_cd_m2: zenith_cd_m2 },
                }
            }
            Model::Gendaylit { irradiances, sun, has_sun, .. } => {
                self.sky_sun = Some(sun);
                let [direct_normal_w_m2, diffuse_horizontal_w_m2] = irradiances;
                if luminance != luminance_cd_m2([1.0; 3]) {
                    note("a factor on a sky of gendaylit is left out");
                }
                SkyKind::Perez { direct_normal_w_m2, diffuse_horizontal_w_m2, has_sun }
            }
        });
    }
}

impl Model {
    /// Of the patterns of a glow.
    fn from_patterns(patterns: &[&Definition]) -> Result<Self, &'static str> {
        let [pattern] = patterns else {
            let other = "a sky of several patterns is left out";
            return if patterns.is_empty() { Ok(Self::Plain) } else { Err(other) };
        };
        let primitive = &pattern.primitive;
        let (strings, reals) = (primitive.strings.as_slice(), primitive.reals.as_slice());
        let [_, functions, options @ ..] = strings else { return Err(OTHER_PATTERN) };
        let turn = turn(pattern, options).ok_or(OTHER_PATTERN)?;
        let is_function = &*primitive.kind == "brightfunc";
        let functions = functions.rsplit(['/', '\\']).next().unwrap_or(functions);
        match (functions, reals) {
            ("skybright.cal", &[number, zenith, ground, ref rest @ ..]) if is_function => {
                let sun = match *rest {
                    [_, x, y, z] => (turn * DVec3::new(x, y, z)).try_normalize(),
                    _ => None,
                };
                let number = number as u8;
                if !zenith.is_finite() || zenith < 0.0 || ground < 0.0 {
                    return Err("a sky of a brightness below 0 is left out");
                }
                match number {
                    1 if sun.is_none() => Err("a clear sky lacks its sun, and is left out"),
                    1..=3 => Ok(Self::Skybright { number, zenith, ground, sun }),
                    _ => Err(INTERMEDIATE),
                }
            }
            (FILE_OF_GENDAYLIT, &[direct, diffuse, x, y, z, has_sun, ground_reflectance]) => {
                let sun = turn * DVec3::new(x, y, z);
                let (irradiances, has_sun) = ([direct, diffuse], has_sun > 0.0);
                Ok(Self::Gendaylit { irradiances, sun, has_sun, ground_reflectance })
            }
            ("perezlum.cal", _) => Err(PEREZ),
            _ => Err(OTHER_PATTERN),
        }
    }

    fn ground(&self, luminance: f64) -> Ground {
        match *self {
            Self::Plain => Ground::Luminance(luminance),
            Self::Skybright { ground, .. } => Ground::Luminance(luminance * ground),
            Self::Gendaylit { ground_reflectance, .. } => Ground::Reflectance(ground_reflectance),
        }
    }
}

const INTERMEDIATE: &str = "there is no intermediate sky here, and it is left out; set [sky] in \
                            the project, model = \"cie\" and type = 7 are near";
const PEREZ: &str = "a sky of gendaylit is known by its irradiances alone, and is left out; write \
                     the command into the scene (!gendaylit .. -W direct diffuse), or set [sky] in \
                     the project";
const OTHER_PATTERN: &str = "the pattern of the sky is not known, and the sky is left out; set \
                             [sky] in the project";

/// The turn of a pattern, by the scene and by options of its own.
fn turn(pattern: &Definition, options: &[std::sync::Arc<str>]) -> Option<DMat3> {
    let words: Vec<String> = options.iter().map(|word| word.to_string()).collect();
    let Parsed { transforms, used } = Transforms::parse(&words).ok()?;
    let own = transforms.copy(0).filter(|_| used == words.len())?;
    Some(own.frame.then(&pattern.frame).turn)
}
