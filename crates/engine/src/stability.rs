//! What of a scene is more than its device bears.

use crate::scene::{Scene, ToolSettings};
use hapflow_haptics::{CouplingKind, LOCAL_DELAYS_S, most_damping, most_stiffness};
use std::f64::consts::PI;

/// Time from a force's leaving until it acts, and by which a device's velocity comes late, s.
const DEVICE_DELAY_S: f64 = 0.004;

impl Scene {
    /// Gains above which a device of `hand.device_mass` and `hand.device_damping` that nobody holds may begin to swing, with
    /// field, value and range: the hand feels the fluid's impedance `force_scale` times `mapping.scale` times, and late. A hand
    /// that holds the device bears more, so that nothing is refused.
    pub fn cautions(&self) -> Vec<String> {
        self.tools().flat_map(|tool| self.cautions_of(tool)).collect()
    }

    fn cautions_of(&self, tool: &ToolSettings) -> Vec<String> {
        let fluid = &self.fluid;
        let radius = tool.form.shape().bounding_radius();
        let [place_s, velocity_s] = self.delays_s();
        // Of a tool under way in the fluid, and of one in its surface; SI, each for a gain of one.
        let drag = 6.0 * PI * fluid.viscosity * radius;
        let lift = fluid.rest_density * fluid.gravity.length() * PI * radius * radius * tool.buoyancy_scale;
        let carried = 0.5 * fluid.rest_density * tool.form.shape().volume();
        let damping = most_damping(self.hand.device_mass_kg, velocity_s);
        let stiffness = most_stiffness(self.hand.device_damping_n_s_per_m, place_s);
        // The proxy of `local` bears any mass.
        let mass =
            if self.run.coupling == CouplingKind::Local { f64::INFINITY } else { self.hand.device_mass_kg };
        // A jet has no surface to float in, and nothing that goes along.
        let pool = if self.pools.is_empty() { 0.0 } else { 1.0 };
        let limits = [
            ("the drag of the fluid", damping / drag),
            ("the lift in the surface", stiffness / (pool * lift)),
            ("the mass of fluid that goes along", mass / (pool * carried)),
        ];
        let gain = tool.force_scale * self.mapping.scale;
        let above = limits.into_iter().filter(|(_, most)| gain > *most);
        above.map(|(what, most)| self.caution(tool, what, most / self.mapping.scale)).collect()
    }

    fn caution(&self, tool: &ToolSettings, what: &str, most: f64) -> String {
        let (scale, mapped) = (tool.force_scale, self.mapping.scale);
        let times = if mapped == 1.0 { String::new() } else { format!(" (times mapping.scale = {mapped})") };
        format!(
            "tool.{}.force_scale = {scale}{times}: from 0 to {most:.2} {what} cannot make a device of {} kg swing by itself that \
             nobody holds; above that a hand has to calm it",
            tool.name, self.hand.device_mass_kg
        )
    }

    /// By how much the force answers late to the hand's place, and to its velocity, s.
    fn delays_s(&self) -> [f64; 2] {
        if self.run.coupling == CouplingKind::Local {
            return LOCAL_DELAYS_S;
        }
        // A frame is computed when its path is complete, and is the mean over it; then its force is held.
        [(self.run.fluid_delay + 1.0) / self.run.fluid_hz + DEVICE_DELAY_S; 2]
    }
}

#[cfg(test)]
mod tests {
    use crate::load;

    #[test]
    fn shipped_scenes_are_calm_and_larger_gains_are_told_with_field_value_and_range() {
        for name in ["tap", "tank", "dip", "stir-water", "stir-honey"] {
            assert_eq!(load(name).map(|s| s.cautions()).unwrap_or_default(), [""; 0], "{name}");
        }
        let told = |name: &str, path: &str, value: f64| {
            let mut scene = load(name).unwrap();
            crate::settings::set(&mut scene, path, &crate::Value::Number(value)).unwrap();
            scene.cautions().join("\n")
        };
        let honey = told("stir-honey", "tool.force_scale", 100.0);
        assert!(
            honey.starts_with("tool.0.force_scale = 100: from 0 to ") && honey.contains("drag"),
            "{honey}"
        );
        assert!(told("dip", "tool.force_scale", 100.0).contains("lift in the surface"));
        assert!(told("dip", "tool.buoyancy_scale", 20.0).contains("lift in the surface"));
        assert!(told("dip", "mapping.scale", 10.0).contains("(times mapping.scale = 10)"));
        // A jet has neither.
        assert_eq!(told("tap", "tool.force_scale", 50.0), "");
        let mut scene = load("dip").unwrap();
        crate::settings::set(&mut scene, "run.coupling", &crate::Value::Text("direct".into())).unwrap();
        crate::settings::set(&mut scene, "tool.force_scale", &crate::Value::Number(100.0)).unwrap();
        assert!(scene.cautions().join("\n").contains("goes along"));
    }
}
