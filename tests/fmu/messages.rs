//! What reaches the host's log.

use super::host::*;
use iwan::fmu::*;
use iwan::joint::Drive;
use std::ffi::CString;
use std::ptr;

/// A message is a printf format: what is in it must come out of printf as it went in.
#[test]
fn percent_signs_survive_the_hosts_printf() {
    let resources = Resources::new(BOLT);
    let hostile = "%s%n%100d 50% \\%";
    let call = Instantiate {
        guid: CString::new(hostile).ok(),
        ..Instantiate::of(&resources, Drive::Force)
    };
    let log = call.call().err().expect("a wrong GUID is refused");
    assert!(log[0].text.contains(hostile), "{}", log[0].text);
    assert!(
        log[0].format.contains("%%s%%n%%100d 50%% \\%%"),
        "{}",
        log[0].format
    );
}

/// A `#` would begin the reference of a variable; the host makes one of two.
#[test]
fn number_signs_are_doubled() {
    let resources = Resources::new(BOLT);
    let call = Instantiate {
        guid: CString::new("#r1# 50 %").ok(),
        ..Instantiate::of(&resources, Drive::Force)
    };
    let log = call.call().err().expect("a wrong GUID is refused");
    assert!(log[0].text.contains("##r1## 50 %"), "{}", log[0].text);
}

#[test]
fn a_refusal_says_function_expected_and_came() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    let told = unit.error(unit.step(0.5, 1e-3));
    assert!(
        told.starts_with("fmi2DoStep: currentCommunicationPoint: expected 0 s"),
        "{told}"
    );
    assert!(told.contains("came 0.5 s"), "{told}");
    let unit = Unit::stepping(&resources, Drive::Force);
    let told = unit.error(unit.step(1e300, 1e-3));
    assert!(told.contains("came 1e300 s"), "{told}");
    let message = unit.log().last().unwrap();
    assert_eq!((message.instance.as_str(), message.status), ("bolt", 3));
    assert_eq!(message.category, "logStatusError");
}

#[test]
fn events_are_told_while_debug_logging_is_on() {
    let resources = Resources::new(BOLT);
    let quiet = Unit::stepping(&resources, Drive::Force);
    assert!(quiet.log().is_empty(), "{:?}", quiet.log());
    let logging = Instantiate {
        logging_on: true,
        ..Instantiate::of(&resources, Drive::Force)
    };
    let unit = logging.call().ok().unwrap();
    assert_eq!(unit.log().len(), 1);
    assert_eq!(
        (unit.log()[0].category.as_str(), unit.log()[0].status),
        ("logEvents", 0)
    );
    unit.ok(unsafe { fmi2SetDebugLogging(unit.handle, FALSE, 0, ptr::null()) });
    unit.ok(unsafe { fmi2Reset(unit.handle) });
    assert_eq!(unit.log().len(), 1);
    let category = c"logEvents".as_ptr();
    unit.ok(unsafe { fmi2SetDebugLogging(unit.handle, TRUE, 1, &category) });
    unit.ok(unsafe { fmi2Reset(unit.handle) });
    assert_eq!(unit.log().last().unwrap().text, "reset");
    let category = c"logNothing".as_ptr();
    let status = unsafe { fmi2SetDebugLogging(unit.handle, TRUE, 1, &category) };
    assert!(unit.error(status).contains("came `logNothing`"));
    let null = ptr::null();
    let status = unsafe { fmi2SetDebugLogging(unit.handle, TRUE, 1, &null) };
    assert!(unit.error(status).contains("came NULL"));
}
