//! LBNL WINDOW files of scattering layers, element by element.
//!
//! The XML of LBNL WINDOW 6 and 7 (schema `BSDF-v1.4.xsd`, root `WindowElement`) holds how a layer
//! reflects and transmits, as a matrix over angular patches (Klems 1994) or as a tensor tree (Ward,
//! Kurt and Bonneel 2012). [`read_bsdf_xml`](crate::read_bsdf_xml) takes the visible data of the
//! first layer. Where no standard says how numbers are ordered and directions oriented, they are
//! read as Radiance reads them, and a test compares with Radiance. Words are read in letters of any
//! case.
//!
//! | element | meaning here |
//! |---|---|
//! | `Optical` / `Layer` | the layer; the first one |
//! | `Material` / `Name`, `Manufacturer`, `Thickness` | facts; `unit` is `meter` (also if missing), `centimeter`, `millimeter`, `inch` or `foot` |
//! | `DataDefinition` / `IncidentDataStructure` | `Columns`, `Rows`: a matrix; `TensorTree3`, `TensorTree4`: a tree of that rank |
//! | .. `AngleBasis` | a basis of the matrix: bands `AngleBasisBlock` with `ThetaBounds` and `nPhis`; not needed for `LBNL/Klems Full` (145 patches), `Half` (73) and `Quarter` (41) |
//! | `WavelengthData` / `LayerNumber` | `System`, if there is one, else that of the first data |
//! | .. `Wavelength` | `Visible` is read; `Solar` if there is nothing else |
//! | .. `WavelengthDataBlock` / `WavelengthDataDirection` | `Transmission Front`, `Transmission Back`, `Reflection Front`, `Reflection Back`: what light that arrives on that side does |
//! | .. `ColumnAngleBasis`, `RowAngleBasis` | the incident and the exit basis of a matrix |
//! | .. `AngleBasis` | of a tree: `LBNL/Shirley-Chiu` |
//! | .. `ScatteringData` | the values in sr^-1, without the cosine of the exit direction |
//!
//! `ScatteringDataType`, spectra of source and detector, and the geometry are not used. Blanks,
//! tabs, line ends and commas separate numbers alike.
//!
//! # How the sheet is mounted
//! `Front` faces outdoors and `Back` faces the room: `Transmission Front` is what light from
//! outdoors does. A scene has the front on the front of the facets, so the normals of a window's
//! facets point outdoors, and `up` is the vertical of the file, its `y` axis. Radiance is the other
//! way round: there the normal of a surface with a BSDF points into the room. Facets of a scene
//! made for Radiance must be turned over.
//!
//! # Matrices
//! `Columns`: each row of the text is one exit patch, each column one incident patch; `Rows`: the
//! other way round. Patches go from the normal to the horizon, in each band counterclockwise, the
//! first one centred at azimuth 0. The azimuth of an incident patch is that of the direction *in
//! which light goes*, so that light that goes straight through, and light that a mirror reflects,
//! stay in the patch of the same number.
//!
//! # Trees
//! A node is `{` 8 or 16 nodes `}`, or `{` a grid of values `}`, 1, 8, 64 .. or 1, 16, 256 .. of
//! them. The axes are those of the incident square and then those of the exit square: the disk of
//! projected directions mapped by Shirley and Chiu (1997), that of the incident direction turned by
//! half a turn as above. In rank 3 the incident axis is (1 - r) / 2, r the sine of the polar angle,
//! so that its upper half is not used, and the exit direction is turned with the azimuth of the
//! incident one. Node number n is in the upper half of axis i where bit i of n is set; in a grid
//! the last axis runs fastest. No more than 12 levels.
//!
//! # Tolerated deviations
//! | rule | what is made of it | for example |
//! |---|---|---|
//! | [`Foreword`] | left out | `1:1: found "Recover using: genBSDF"; expected XML from the first line on (left out)` |
//! | [`SeveralLayers`] | the first is read | `90:3: found another Layer; expected one layer (the first is read)` |
//! | [`UnknownThickness`] | left out: nothing depends on it | `9:5: found a thickness of "1" "mil"; expected a number from 0 on, in meter, ... (left out)` |
//! | [`SolarOnly`] | read as if it were visible | `40:2: found Solar data alone; expected Visible (read as if it were)` |
//! | [`ColourLeftOut`] | the luminance counts | `40:2: found data of the colour; expected Visible alone (the colour is left out)` |
//! | [`UnknownDirection`] | left out | `50:3: found "Absorptance Front"; expected Transmission or Reflection, ... (left out)` |
//! | [`RepeatedBlock`] | the last one is read | `70:3: found another transmission front; expected each direction once (...)` |
//! | [`TrailingValues`] | left out | `99:1: found "0.5"; expected the end of the data after 21025 values (left out)` |
//! | [`NegativeScattering`] | read as 0 | `60:9: found "-0.001"; expected no negative value (read as 0)` |
//! | [`ByReciprocity`] | f'(wi, wo) = f(wo, wi), from the other side | `50:3: found no Transmission back; expected both directions (taken from the other one by reciprocity)` |
//! | [`OneWayTransmission`] | nothing passes from that side | `50:3: found no Transmission back; expected both directions (this table cannot be turned round: nothing passes)` |
//! | [`MissingReflection`] | nothing is reflected there | `50:3: found no Reflection back; expected the reflection of both sides (nothing is reflected)` |
//! | [`LayersLeftOut`] | left out | `90:3: found LayerNumber "1"; expected "System" alone (the data of other layers are left out)` |
//! | [`BasisEndsEarly`] | light beyond the last band is absorbed, and none goes there | `50:3: found the basis "b" that ends 80.0 degrees from the normal; expected bands to 90 degrees (...)` |
//! | [`EnergyNotConserved`] | used as it is, refused from 1000 times the light on | `50:3: found 101.3 % of the light scattered at 82.5 degrees on the front; expected no more than 100 % (used as it is)` |
//! | [`NotReciprocal`] | used as it is | `50:3: found reflection front that differs from that of swapped directions by 7.0 % in the mean; expected the same both ways round (used as it is)` |
//!
//! [`Foreword`]: crate::WarningKind::Foreword
//! [`SeveralLayers`]: crate::WarningKind::SeveralLayers
//! [`UnknownThickness`]: crate::WarningKind::UnknownThickness
//! [`SolarOnly`]: crate::WarningKind::SolarOnly
//! [`ColourLeftOut`]: crate::WarningKind::ColourLeftOut
//! [`UnknownDirection`]: crate::WarningKind::UnknownDirection
//! [`RepeatedBlock`]: crate::WarningKind::RepeatedBlock
//! [`TrailingValues`]: crate::WarningKind::TrailingValues
//! [`NegativeScattering`]: crate::WarningKind::NegativeScattering
//! [`ByReciprocity`]: crate::WarningKind::ByReciprocity
//! [`OneWayTransmission`]: crate::WarningKind::OneWayTransmission
//! [`EnergyNotConserved`]: crate::WarningKind::EnergyNotConserved
//! [`NotReciprocal`]: crate::WarningKind::NotReciprocal
//! [`MissingReflection`]: crate::WarningKind::MissingReflection
//! [`LayersLeftOut`]: crate::WarningKind::LayersLeftOut
//! [`BasisEndsEarly`]: crate::WarningKind::BasisEndsEarly
