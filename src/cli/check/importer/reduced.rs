//! An archive of FMI 3.0 with only that part of its modelDescription.xml which the importer reads.
//!
//! `fmi-schema` 0.8, by which the `fmi` crate reads the XML, knows no `unit` of a `Float64` and refuses
//! every attribute it does not know: no archive with units would be loaded. The importer itself asks
//! for identifier, token and default experiment; the variables are held against the joint by
//! [`validation`](crate::cli::check::validation), from the whole XML.

use crate::cli::check::validation::{Elements, elements};
use quick_xml::Writer;
use quick_xml::events::{BytesEnd, BytesStart, Event};
use std::fs::File;
use std::io::{Cursor, Error, Read, Result, Write};
use std::path::Path;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

const DESCRIPTION: &str = "modelDescription.xml";
/// Element, and its attributes that are kept.
const KEPT: [(&str, &[&str]); 3] = [
    (
        "fmiModelDescription",
        &["fmiVersion", "modelName", "instantiationToken"],
    ),
    ("CoSimulation", &["modelIdentifier"]),
    ("DefaultExperiment", &["stepSize"]),
];

/// The whole archive under such a description, not compressed.
///
/// # Errors
/// What reading the archive or its XML brings.
pub fn archive(path: &Path) -> Result<Cursor<Vec<u8>>> {
    let mut old = ZipArchive::new(File::open(path)?)?;
    let mut new = ZipWriter::new(Cursor::new(Vec::new()));
    let names: Vec<String> = old.file_names().map(str::to_owned).collect();
    let stored = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for name in names.iter().filter(|name| !name.ends_with('/')) {
        let mut bytes = Vec::new();
        old.by_name(name)?.read_to_end(&mut bytes)?;
        if name == DESCRIPTION {
            let text = String::from_utf8(bytes).map_err(Error::other)?;
            bytes = description(&elements(&text).map_err(Error::other)?)?;
        }
        new.start_file(name, stored)?;
        new.write_all(&bytes)?;
    }
    Ok(new.finish()?)
}

fn description(elements: &Elements) -> Result<Vec<u8>> {
    let mut writer = Writer::new(Vec::new());
    let of = |(name, kept): &(&'static str, &[&str])| {
        let (_, attributes) = elements.iter().find(|element| element.0 == *name)?;
        let kept = kept.iter();
        let kept = kept.filter_map(|key| Some((*key, attributes.get(*key)?.as_str())));
        Some(BytesStart::new(*name).with_attributes(kept))
    };
    let [root, inner @ ..] = &KEPT;
    let start = of(root).ok_or_else(|| Error::other(format!("no element {}", root.0)))?;
    writer.write_event(Event::Start(start))?;
    for element in inner.iter().filter_map(of) {
        writer.write_event(Event::Empty(element))?;
    }
    writer.write_event(Event::End(BytesEnd::new(root.0)))?;
    Ok(writer.into_inner())
}
