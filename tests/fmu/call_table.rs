//! Every function of a version of FMI with the modes in which it may be called, and one way to call
//! it: as it should be, or with one of its pointers NULL.

use super::host::Resources;
use iwan::fmu::{Component, Status};
use std::cell::Cell;
use std::ptr;

/// Instantiated, initialization, stepping, terminated: the states of FMI 2.0.4, section 4.2.4, and of
/// FMI 3.0, section 4.2, for co-simulation without event mode.
pub const MODES: [char; 4] = ['I', 'N', 'S', 'T'];

/// One function.
pub struct Row<U> {
    pub name: &'static str,
    /// Letters of [`MODES`] in which it may be called.
    pub allowed: &'static str,
    pub call: fn(&U, &Turn) -> Status,
}

impl<U> Row<U> {
    pub fn allowed_in(&self, mode: char) -> bool {
        self.allowed.contains(mode)
    }

    /// With nothing spoiled, as far as anything but the mode goes.
    pub fn plainly(&self, unit: &U) -> Status {
        (self.call)(unit, &Turn::none())
    }
}

/// What became NULL in a call.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spoiled {
    Nothing,
    Handle,
    /// Something that must be there.
    Needed,
    /// Something that may be NULL.
    Optional,
}

/// Hands the arguments of a call through, and makes one of its pointers NULL.
pub struct Turn {
    place: Option<usize>,
    seen: Cell<usize>,
    spoiled: Cell<Spoiled>,
}

impl Turn {
    pub fn none() -> Turn {
        Turn {
            place: None,
            seen: Cell::new(0),
            spoiled: Cell::new(Spoiled::Nothing),
        }
    }

    /// The pointer with this number, from the handle on.
    pub fn of(place: usize) -> Turn {
        Turn {
            place: Some(place),
            ..Turn::none()
        }
    }

    pub fn spoiled(&self) -> Spoiled {
        self.spoiled.get()
    }

    fn is_it(&self, kind: Spoiled) -> bool {
        let number = self.seen.replace(self.seen.get() + 1);
        let is_it = self.place == Some(number);
        if is_it {
            self.spoiled.set(kind);
        }
        is_it
    }

    pub fn handle(&self, handle: Component) -> Component {
        if self.is_it(Spoiled::Handle) {
            ptr::null_mut()
        } else {
            handle
        }
    }

    pub fn read<T>(&self, pointer: *const T) -> *const T {
        if self.is_it(Spoiled::Needed) {
            ptr::null()
        } else {
            pointer
        }
    }

    pub fn write<T>(&self, pointer: *mut T) -> *mut T {
        self.read(pointer).cast_mut()
    }

    pub fn optional<T>(&self, pointer: *const T) -> *const T {
        if self.is_it(Spoiled::Optional) {
            ptr::null()
        } else {
            pointer
        }
    }

    pub fn plain<T>(&self, value: T) -> T {
        value
    }

    /// Of arrays for which there is nothing: none of them, but one where a pointer is NULL.
    pub fn count(&self, count: usize) -> usize {
        if self.place.is_some() { count } else { 0 }
    }
}

/// Rows of functions: name, modes, and each argument after the handle by how [`Turn`] hands it on.
macro_rules! rows {
    ($($name:ident $allowed:literal ($($kind:ident $argument:expr),*);)*) => {
        vec![$(Row {
            name: stringify!($name),
            allowed: $allowed,
            // SAFETY: pointers to places of this call, or NULL, with counts that fit them.
            call: |unit: &Self, turn: &Turn| unsafe { $name(turn.handle(unit.handle), $(turn.$kind($argument)),*) },
        }),*]
    };
}
pub(crate) use rows;

/// The six functions of saved states, of one version: as a row of the table, and to look at a state.
macro_rules! state_functions {
    ($unit:ty: $get:ident $size:ident $serialize:ident $deserialize:ident $set:ident $free:ident) => {
        const BESIDE: &[&str] = &[
            stringify!($size),
            stringify!($serialize),
            stringify!($deserialize),
            stringify!($set),
            stringify!($free),
        ];

        const STATES: Row<$unit> = Row {
            name: stringify!($get),
            allowed: "INST",
            call: states,
        };

        /// A state saved, as bytes, back from them, put back and freed; the first refusal ends it.
        fn states(unit: &$unit, turn: &Turn) -> Status {
            let (mut state, mut copy, mut size) = (null_mut(), null_mut(), 0);
            let ok = |status| {
                if status == Status::Ok {
                    Ok(())
                } else {
                    Err(status)
                }
            };
            let handle = || turn.handle(unit.handle);
            // SAFETY: pointers to places of this call, or NULL, with counts that fit them.
            let status = (|| unsafe {
                ok($get(handle(), turn.write(&mut state)))?;
                ok($size(handle(), turn.write(state), turn.write(&mut size)))?;
                let mut bytes = vec![0_u8; size];
                let place = bytes.as_mut_ptr();
                ok($serialize(
                    handle(),
                    turn.write(state),
                    turn.write(place).cast(),
                    size,
                ))?;
                let (from, to) = (turn.read(place).cast(), turn.write(&mut copy));
                ok($deserialize(handle(), from, size, to))?;
                ok($set(handle(), turn.write(copy)))?;
                let mut none: FmuState = null_mut();
                ok($free(handle(), turn.optional(&raw mut none).cast_mut()))
            })();
            for mut state in [state, copy] {
                unit.ok(unsafe { $free(unit.handle, &mut state) });
                assert!(state.is_null());
            }
            status.err().unwrap_or(Status::Ok)
        }

        /// The complete state.
        fn bytes(unit: &$unit) -> Vec<u8> {
            let (mut state, mut size) = (null_mut(), 0);
            unsafe {
                unit.ok($get(unit.handle, &mut state));
                unit.ok($size(unit.handle, state, &mut size));
                let mut bytes = vec![0_u8; size];
                unit.ok($serialize(
                    unit.handle,
                    state,
                    bytes.as_mut_ptr().cast(),
                    size,
                ));
                unit.ok($free(unit.handle, &mut state));
                bytes
            }
        }

        fn restore(unit: &$unit, bytes: &[u8]) {
            let mut state = null_mut();
            unsafe {
                unit.ok($deserialize(
                    unit.handle,
                    bytes.as_ptr().cast(),
                    bytes.len(),
                    &mut state,
                ));
                unit.ok($set(unit.handle, state));
                unit.ok($free(unit.handle, &mut state));
            }
        }
    };
}
pub(crate) use state_functions;

/// What the tables ask of an instance of either version.
pub trait Hosted: Sized {
    /// All its functions but those that make and free instances.
    fn table() -> Vec<Row<Self>>;
    /// Those that a row of the table calls beside the one it is named after.
    const BESIDE: &'static [&'static str];

    fn instantiated(resources: &Resources) -> Self;
    /// The last message.
    fn told(&self) -> Option<String>;
    /// The complete state.
    fn bytes(&self) -> Vec<u8>;
    /// As after instantiation, then with everything that the bytes say.
    fn restore(&self, bytes: &[u8]);

    /// An instance in this mode.
    fn in_mode(mode: char, resources: &Resources) -> Self {
        let unit = Self::instantiated(resources);
        let way = [
            "EnterInitializationMode",
            "ExitInitializationMode",
            "Terminate",
        ];
        let count = MODES.iter().position(|other| *other == mode).unwrap();
        for name in &way[..count] {
            let table = Self::table();
            let row = table.iter().find(|row| row.name[4..] == **name).unwrap();
            assert_eq!(row.plainly(&unit), Status::Ok, "{:?}", unit.told());
        }
        unit
    }

    /// Makes a call and holds its answer against the table; what is refused changes nothing.
    /// Returns the mode afterwards.
    #[track_caller]
    fn obey(&self, mode: char, row: &Row<Self>) -> char {
        let before = self.bytes();
        let status = row.plainly(self);
        let told = self.told();
        if row.allowed_in(mode) {
            assert_eq!(status, Status::Ok, "{} in {mode}: {told:?}", row.name);
            return match &row.name[4..] {
                "EnterInitializationMode" => 'N',
                "ExitInitializationMode" => 'S',
                "Terminate" => 'T',
                "Reset" => 'I',
                _ => mode,
            };
        }
        assert_eq!(status, Status::Error, "{} in {mode}", row.name);
        let told = told.expect("a refusal is told");
        let expected = format!("{}: expected ", row.name);
        assert!(told.starts_with(&expected), "{told}");
        assert_eq!(self.bytes(), before, "{} in {mode}", row.name);
        mode
    }
}
