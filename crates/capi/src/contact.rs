//! `hapflow_contact`: what a tool touches; and its proxy.

use crate::caller::{Buffer, Element, Out};
use crate::code::{Code, Failure};
use crate::contract::as_in_header;
use crate::generated as c;
use crate::handle::Handle;
use crate::session::with_main;
use hapflow_haptics::{Contact, MAX_CONTACTS, SolidKind};

const _: () = assert!(MAX_CONTACTS == c::HAPFLOW_MAX_CONTACTS as usize);

/// `hapflow_contact`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct ContactRecord {
    solid: u32,
    index: u32,
    depth: f64,
    point: [f64; 3],
    normal: [f64; 3],
    force: [f64; 3],
}

as_in_header!(ContactRecord = hapflow_contact { solid, index, depth, point, normal, force });

impl Element for ContactRecord {
    const FIRST_SIZE: usize = 88;
}

impl From<&Contact> for ContactRecord {
    fn from(contact: &Contact) -> Self {
        Self {
            solid: match contact.kind {
                SolidKind::Ground => c::HAPFLOW_SOLID_GROUND,
                SolidKind::Container => c::HAPFLOW_SOLID_CONTAINER,
                SolidKind::Obstacle => c::HAPFLOW_SOLID_OBSTACLE,
            },
            index: contact.index,
            depth: contact.depth_m,
            point: contact.point.to_array(),
            normal: contact.normal.to_array(),
            force: contact.force.to_array(),
        }
    }
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_contacts(
    session: Handle,
    tool: u32,
    contacts: Buffer<ContactRecord>,
    size: u32,
    capacity: usize,
    count: Out<usize>,
) -> Code {
    with_main(session, |side| {
        contacts.check(capacity, count)?;
        let touching = side.touching(tool)?;
        let records: Vec<_> = touching.contacts().iter().map(ContactRecord::from).collect();
        Ok(contacts.enumerate_sized(size, capacity, count, &records)?)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_session_proxy(
    session: Handle,
    tool: u32,
    position: Out<[f64; 3]>,
    orientation: Out<[f64; 4]>,
) -> Code {
    with_main(session, |side| {
        position.check().and(orientation.check()).map_err(Failure::from)?;
        let touching = side.touching(tool)?;
        position.put(touching.proxy.to_array())?;
        orientation.put(touching.orientation.to_array())?;
        Ok(Code::OK)
    })
}
