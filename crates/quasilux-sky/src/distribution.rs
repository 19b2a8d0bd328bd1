//! How the luminance of a sky is distributed, up to a factor.

use crate::cie::CieType;
use crate::gradation::Gradation;
use crate::panorama::Panorama;
use crate::perez::Perez;
use crate::point::{SkyPoint, dot};
use crate::quadrature::over_the_sky;
use std::sync::Arc;

/// Relative luminances of a sky.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    form: Form,
    /// Towards the sun, which may be below the horizon.
    sun: [f64; 3],
}

#[derive(Clone, Debug, PartialEq)]
enum Form {
    Uniform,
    /// 1 + 2 sin(altitude).
    TraditionalOvercast,
    Gradation(Gradation),
    /// A gradation with [`Perez::is_held`].
    Held(Gradation),
    /// In cd/m2.
    Panorama(Arc<Panorama>),
}

impl Distribution {
    /// The same in all directions.
    #[must_use]
    pub fn uniform() -> Self {
        Self { form: Form::Uniform, sun: [0.0, 0.0, 1.0] }
    }

    /// A CIE sky with the sun at this point; on types 1, 3, 5 and 16 it has no influence.
    #[must_use]
    pub fn cie(cie: CieType, sun: SkyPoint) -> Self {
        let form = cie.gradation().map_or(Form::TraditionalOvercast, Form::Gradation);
        Self { form, sun: sun.to_direction() }
    }

    /// The sky of a measured hour.
    #[must_use]
    pub fn perez(perez: &Perez) -> Self {
        let form = if perez.is_held() { Form::Held } else { Form::Gradation };
        Self { form: form(perez.gradation()), sun: perez.sun().to_direction() }
    }

    /// The sky of a picture; its relative luminances are those of the picture in cd/m2.
    #[must_use]
    pub fn panorama(panorama: Panorama) -> Self {
        let form = Form::Panorama(Arc::new(panorama));
        Self { form, sun: [0.0, 0.0, 1.0] }
    }

    /// The relative luminance in a direction, a unit vector; 0 below the horizon.
    #[must_use]
    pub fn relative(&self, direction: [f64; 3]) -> f64 {
        let cos_zenith = direction[2];
        if cos_zenith < 0.0 {
            return 0.0;
        }
        match &self.form {
            Form::Uniform => 1.0,
            Form::TraditionalOvercast => 1.0 + 2.0 * cos_zenith,
            Form::Gradation(gradation) | Form::Held(gradation) => {
                gradation.relative(cos_zenith, dot(direction, self.sun))
            }
            Form::Panorama(panorama) => panorama.luminance_cd_m2(direction),
        }
    }

    pub(crate) fn is_held(&self) -> bool {
        matches!(self.form, Form::Held(_))
    }

    /// The gradation that it is of.
    pub(crate) fn as_gradation(&self) -> Option<&Gradation> {
        match &self.form {
            Form::Gradation(gradation) | Form::Held(gradation) => Some(gradation),
            _ => None,
        }
    }

    /// Towards the sun.
    pub(crate) fn sun(&self) -> [f64; 3] {
        self.sun
    }

    /// The panorama that it is of.
    pub(crate) fn as_panorama(&self) -> Option<&Panorama> {
        match &self.form {
            Form::Panorama(panorama) => Some(panorama),
            _ => None,
        }
    }

    /// The horizontal illuminance of relative luminances.
    pub(crate) fn horizontal(&self) -> f64 {
        match &self.form {
            Form::Panorama(panorama) => panorama.horizontal_illuminance_lx(),
            _ => over_the_sky(self.sun, |direction| self.relative(direction) * direction[2]),
        }
    }
}
