//! What the fuzz targets of one kind have in common.

use knotproof::curve::{read_curve, write_curve};
use knotproof::import::{Format, Options, import_as};

/// A reader of another format returns; what it accepts is written and read back the same. The last byte chooses the options.
pub fn import(format: Format, bytes: &[u8]) {
    let flags = bytes.last().copied().unwrap_or_default();
    let options = Options {
        weld: flags & 1 != 0,
        smooth: flags & 2 != 0,
        exact: flags & 12 == 12,
        ..Options::default()
    };
    match import_as(format, bytes, &options) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(imported) => {
            for curve in imported.curves.iter().take(16) {
                let again = read_curve(write_curve(&curve.curve, Some(&curve.title()))).expect("written by us");
                assert_eq!(again.curve, curve.curve);
            }
        }
    }
}
