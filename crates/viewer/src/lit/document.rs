//! Members of a glTF document, or what was expected there.

use serde_json::Value;

use crate::Error;

/// An array, empty where there is none.
pub(super) fn array<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value.get(name).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// A name, empty where there is none.
pub(super) fn text(value: &Value, name: &str) -> String {
    value.get(name).and_then(Value::as_str).unwrap_or_default().to_owned()
}

/// A count or an index.
pub(super) fn index(value: &Value, name: &str, at: &str) -> Result<usize, Error> {
    let number = value.get(name).and_then(Value::as_u64).and_then(|n| usize::try_from(n).ok());
    number.ok_or_else(|| Error::new(format!("{at}.{name}: expected a number from 0")))
}

/// Three finite numbers.
pub(super) fn triple(value: &Value, name: &str, at: &str) -> Result<[f64; 3], Error> {
    let numbers = value.get(name).and_then(Value::as_array);
    let numbers =
        numbers.and_then(|list| list.iter().map(Value::as_f64).collect::<Option<Vec<_>>>());
    match numbers.as_deref() {
        Some(&[x, y, z]) if [x, y, z].iter().all(|c| c.is_finite()) => Ok([x, y, z]),
        _ => Err(Error::new(format!("{at}.{name}: expected three numbers"))),
    }
}
