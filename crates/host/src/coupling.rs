//! A coupling of a plugin.

use crate::PluginError;
use crate::extension::{Library, Table};
use crate::failure::Failure;
use crate::generated::*;
use crate::limits::{FASTEST, within};
use glam::DVec3;
use hapflow_haptics::{Answer, BodyState, Coupling, Drive, FrameEnd, ToolState, Wrench};
use std::ffi::c_void;
use std::mem::size_of;
use std::ptr;

// SAFETY: numbers, a text and functions that may be null.
unsafe impl Table for hapflow_coupling_extension {
    const NAME: &'static [u8] = HAPFLOW_EXTENSION_COUPLING;
}

type Begin =
    unsafe extern "C" fn(*mut c_void, *const hapflow_coupling_frame, *mut u32, *mut f64) -> hapflow_result;
type End =
    unsafe extern "C" fn(*mut c_void, *const hapflow_coupling_frame, *mut hapflow_wrench) -> hapflow_result;

#[derive(Clone, Copy)]
struct Functions {
    name: &'static str,
    create: unsafe extern "C" fn(*mut *mut c_void) -> hapflow_result,
    begin: Begin,
    end: End,
    destroy: unsafe extern "C" fn(*mut c_void),
}

/// A plugin's coupling, of which those of tools are made.
#[derive(Clone)]
pub struct PluginCoupling {
    functions: Functions,
    failure: Failure,
}

impl PluginCoupling {
    pub(crate) fn of(library: &Library) -> Result<Option<Self>, PluginError> {
        let Some(table) = library.table::<hapflow_coupling_extension>()? else { return Ok(None) };
        let functions = Functions {
            name: library.name(table.name)?,
            create: library.required(table.create, "create")?,
            begin: library.required(table.begin, "begin")?,
            end: library.required(table.end, "end")?,
            destroy: library.required(table.destroy, "destroy")?,
        };
        Ok(Some(Self { functions, failure: Failure::default() }))
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        self.functions.name
    }

    /// Why one of its couplings failed first while it ran.
    pub fn failure(&self) -> Option<&str> {
        self.failure.reason()
    }

    /// Makes one for a tool.
    ///
    /// # Errors
    /// A sentence on why it cannot be made.
    pub fn create(&self) -> Result<Box<dyn Coupling>, String> {
        let mut coupling = ptr::null_mut();
        // SAFETY: `coupling` is there to be written.
        let result = unsafe { (self.functions.create)(&mut coupling) };
        if result < 0 {
            return Err(format!("coupling {} cannot be made: result {result}", self.name()));
        }
        let Self { functions, failure } = self.clone();
        Ok(Box::new(ToolCoupling { functions, failure, coupling, hand: ToolState::default(), begun: false }))
    }
}

/// The coupling of a tool.
struct ToolCoupling {
    functions: Functions,
    failure: Failure,
    coupling: *mut c_void,
    hand: ToolState,
    /// Whether the frame began without a failure.
    begun: bool,
}

// SAFETY: the plugin is told that it is called in one thread at a time, and not which.
unsafe impl Send for ToolCoupling {}

impl ToolCoupling {
    fn frame(&self, body: &BodyState, load: Wrench, frame_s: f64) -> hapflow_coupling_frame {
        hapflow_coupling_frame {
            size: size_of::<hapflow_coupling_frame>() as u32,
            reserved: 0,
            frame_s,
            body_position: body.position.to_array(),
            body_velocity: body.velocity.to_array(),
            body_mass: body.mass,
            hand_position: self.hand.position.to_array(),
            hand_velocity: self.hand.velocity.to_array(),
            load: hapflow_wrench { force: load.force.to_array(), torque: load.torque.to_array() },
        }
    }

    /// Whether a function did what it should; else the reason is kept.
    fn holds(&self, function: &str, result: hapflow_result, sound: bool) -> bool {
        let holds = result >= 0 && sound;
        if !holds {
            let what = if result < 0 { format!("result {result}") } else { "numbers that cannot be".into() };
            self.failure.tell(|| format!("coupling {}: {function} gave {what}", self.functions.name));
        }
        holds
    }
}

impl Coupling for ToolCoupling {
    fn begin_frame(&mut self, body: &BodyState, device: &ToolState, frame_s: f64) -> Drive {
        self.hand = *device;
        let frame = self.frame(body, Wrench::ZERO, frame_s);
        let (mut driven, mut velocity) = (0, [0.0; 3]);
        // SAFETY: all are there for the call, and `velocity` has room for three numbers.
        let result =
            unsafe { (self.functions.begin)(self.coupling, &frame, &mut driven, velocity.as_mut_ptr()) };
        self.begun = self.holds("begin", result, within(velocity, FASTEST));
        if self.begun && driven != 0 {
            Drive::Driven { velocity: DVec3::from_array(velocity) }
        } else {
            Drive::Led
        }
    }

    /// Not finite where the plugin failed: the session makes a fault of it.
    fn end_frame(&mut self, frame: &FrameEnd<'_>) -> Answer {
        let at_end = self.frame(&frame.body, frame.load, frame.frame_s);
        let mut felt = hapflow_wrench { force: [0.0; 3], torque: [0.0; 3] };
        // SAFETY: all are there for the call.
        let result = unsafe { (self.functions.end)(self.coupling, &at_end, &mut felt) };
        let wrench = Wrench { force: DVec3::from_array(felt.force), torque: DVec3::from_array(felt.torque) };
        let holds = self.holds("end", result, wrench.is_finite()) && self.begun;
        Answer { wrench: if holds { wrench } else { Wrench::from_force(DVec3::NAN) }, ..Answer::default() }
    }
}

impl Drop for ToolCoupling {
    fn drop(&mut self) {
        // SAFETY: it was made by the same table, and is not used again.
        unsafe { (self.functions.destroy)(self.coupling) };
    }
}
