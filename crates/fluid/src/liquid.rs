//! Liquids by name: density, viscosity and surface tension of what people know.
//!
//! | liquid | at | source |
//! |---|---|---|
//! | water | 20 °C | density and viscosity: IAPWS (R12-08 for the viscosity); surface tension: IAPWS R1-76 |
//! | oil | 20 °C | olive oil: Coupland & McClements 1997 (doi:10.1007/s11746-997-0077-1); tension of vegetable oils against air, 0.032 to 0.034 N/m |
//! | glycerine | 20 °C | pure: Segur & Oberstar 1951 (doi:10.1021/ie50501a040); tension: Glycerine Producers' Association 1963 |
//! | honey | 25 °C | clover honey of 16 % water, between 19 Pa·s at 20 °C and 6.5 Pa·s at 30 °C (Munro 1943); a per cent of water more halves it; tension 0.05 to 0.06 N/m |
//!
//! Oil and honey are natural products: their values are typical, and differ from one to the next more than the last
//! digit says.

use crate::FluidSettings;

/// A liquid with known properties.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Liquid {
    /// Pure water at 20 °C.
    Water,
    /// Olive oil at 20 °C.
    Oil,
    /// Pure glycerine at 20 °C.
    Glycerine,
    /// Liquid honey of 16 % water at 25 °C.
    Honey,
}

/// What makes a liquid the one that it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiquidProperties {
    /// Density, kg/m³.
    pub density: f64,
    /// Dynamic viscosity, Pa·s.
    pub viscosity: f64,
    /// Surface tension against air, N/m.
    pub surface_tension: f64,
}

impl Liquid {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Water, Self::Oil, Self::Glycerine, Self::Honey];

    /// Its properties; sources are at the head of the file.
    pub const fn properties(self) -> LiquidProperties {
        let [density, viscosity, surface_tension] = match self {
            Self::Water => [998.2, 1.002e-3, 0.0727],
            Self::Oil => [915.0, 0.084, 0.033],
            Self::Glycerine => [1261.0, 1.41, 0.0634],
            Self::Honey => [1430.0, 10.0, 0.055],
        };
        LiquidProperties { density, viscosity, surface_tension }
    }
}

impl FluidSettings {
    /// The liquid whose density, viscosity and surface tension these are, if there is one.
    pub fn liquid(&self) -> Option<Liquid> {
        let own = LiquidProperties {
            density: self.rest_density,
            viscosity: self.viscosity,
            surface_tension: self.surface_tension,
        };
        Liquid::ALL.into_iter().find(|liquid| liquid.properties() == own)
    }

    /// Takes density, viscosity and surface tension of `liquid`.
    pub fn set_liquid(&mut self, liquid: Liquid) {
        let LiquidProperties { density, viscosity, surface_tension } = liquid.properties();
        (self.rest_density, self.viscosity, self.surface_tension) = (density, viscosity, surface_tension);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_liquid_is_known_by_its_properties_and_by_all_of_them() {
        for liquid in Liquid::ALL {
            let mut settings = FluidSettings::default();
            settings.set_liquid(liquid);
            assert_eq!(settings.liquid(), Some(liquid));
            settings.viscosity *= 1.01;
            assert_eq!(settings.liquid(), None);
        }
        assert_eq!(FluidSettings::default().liquid(), None);
    }

    /// Held against formulas of the literature, not against the table's own digits.
    #[test]
    fn water_and_glycerine_are_those_of_the_formulas() {
        // IAPWS R1-76: surface tension of water, N/m.
        let tau = 1.0_f64 - 293.15 / 647.096;
        let tension = 0.2358 * tau.powf(1.256) * (1.0 - 0.625 * tau);
        // Cheng 2008 (doi:10.1021/ie071349z): viscosities of water and glycerine, Pa·s, at t °C.
        let t = 20.0_f64;
        let water = 1.790e-3 * ((-1230.0 - t) * t / (36_100.0 + 360.0 * t)).exp();
        let glycerine = 12.1 * ((-1233.0 + t) * t / (9900.0 + 70.0 * t)).exp();
        let near = |value: f64, formula: f64| (value / formula - 1.0).abs() < 0.005;
        assert!(near(Liquid::Water.properties().surface_tension, tension), "{tension}");
        assert!(near(Liquid::Water.properties().viscosity, water), "{water}");
        assert!(near(Liquid::Glycerine.properties().viscosity, glycerine), "{glycerine}");
    }
}
