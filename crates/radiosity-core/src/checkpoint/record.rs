//! Values as bytes: little-endian, fields in their order, nothing in between.

use std::io::{self, Write};

use scene::Rgb;

use super::Inconsistent;

/// A value that can be written and read again to the bit.
pub(crate) trait Record: Sized {
    /// Appends the value.
    fn write(&self, out: &mut dyn Write) -> io::Result<()>;

    /// Takes the value off the front.
    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent>;
}

/// Bytes not read yet.
pub(crate) struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], Inconsistent> {
        let (first, rest) = self.rest.split_first_chunk().ok_or(Inconsistent("it is cut short"))?;
        self.rest = rest;
        Ok(*first)
    }

    /// Makes sure that nothing is left.
    pub(crate) fn end(self) -> Result<(), Inconsistent> {
        if self.rest.is_empty() { Ok(()) } else { Err(Inconsistent("something follows its end")) }
    }
}

/// Implements [`Record`] for a struct by its fields.
macro_rules! record {
    ($type:ty { $($field:ident),* $(,)? }) => {
        impl $crate::checkpoint::Record for $type {
            fn write(&self, out: &mut dyn ::std::io::Write) -> ::std::io::Result<()> {
                $($crate::checkpoint::Record::write(&self.$field, out)?;)*
                Ok(())
            }

            fn read(
                from: &mut $crate::checkpoint::Reader<'_>,
            ) -> Result<Self, $crate::checkpoint::Inconsistent> {
                Ok(Self { $($field: $crate::checkpoint::Record::read(from)?),* })
            }
        }
    };
}
pub(crate) use record;

/// Implements [`Record`] for an enum of plain names: a byte each, in the order given.
macro_rules! tags {
    ($type:ident { $($name:ident),* $(,)? }) => {
        impl $crate::checkpoint::Record for $type {
            fn write(&self, out: &mut dyn ::std::io::Write) -> ::std::io::Result<()> {
                let all = [$($type::$name),*];
                let tag = all.iter().position(|t| t == self).expect("all names are given");
                out.write_all(&[tag as u8])
            }

            fn read(
                from: &mut $crate::checkpoint::Reader<'_>,
            ) -> Result<Self, $crate::checkpoint::Inconsistent> {
                let all = [$($type::$name),*];
                let tag = <u8 as $crate::checkpoint::Record>::read(from)?;
                let unknown = $crate::checkpoint::Inconsistent("it has a tag that nothing has");
                all.get(usize::from(tag)).copied().ok_or(unknown)
            }
        }
    };
}
pub(crate) use tags;

macro_rules! plain {
    ($($type:ty),*) => {$(
        impl Record for $type {
            fn write(&self, out: &mut dyn Write) -> io::Result<()> {
                out.write_all(&self.to_le_bytes())
            }

            fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
                Ok(<$type>::from_le_bytes(from.take()?))
            }
        }
    )*};
}

plain!(u8, u32, u64);

impl Record for usize {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        (*self as u64).write(out)
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        usize::try_from(u64::read(from)?).map_err(|_| Inconsistent("it has a count out of range"))
    }
}

impl Record for bool {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        u8::from(*self).write(out)
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        match u8::read(from)? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(Inconsistent("it has a tag that nothing has")),
        }
    }
}

/// A finite number: with any other, light could never end.
impl Record for f64 {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(&self.to_le_bytes())
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        let value = Loose::read(from)?.0;
        if value.is_finite() { Ok(value) } else { Err(Inconsistent("it has a number too large")) }
    }
}

/// A number that may be infinite, or none: an error that nothing is known of.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Loose(pub(crate) f64);

impl Record for Loose {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(out)
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        Ok(Self(f64::from_le_bytes(from.take()?)))
    }
}

impl Record for Rgb {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.0.write(out)
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        Ok(Self(Record::read(from)?))
    }
}

impl<T: Record + Copy + Default, const N: usize> Record for [T; N] {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.iter().try_for_each(|value| value.write(out))
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        let mut values = [T::default(); N];
        for value in &mut values {
            *value = T::read(from)?;
        }
        Ok(values)
    }
}

impl<T: Record> Record for Option<T> {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.is_some().write(out)?;
        self.as_ref().map_or(Ok(()), |value| value.write(out))
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        Ok(if bool::read(from)? { Some(T::read(from)?) } else { None })
    }
}

impl<T: Record> Record for Vec<T> {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.len().write(out)?;
        self.iter().try_for_each(|value| value.write(out))
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        // Grows as values come: no length is believed before.
        let length = usize::read(from)?;
        (0..length).map(|_| T::read(from)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Copy, Debug, PartialEq)]
    enum Name {
        One,
        Other,
    }

    #[derive(Debug, PartialEq)]
    struct Thing {
        name: Name,
        lit: Option<Vec<Rgb>>,
        count: usize,
    }

    tags!(Name { One, Other });
    record!(Thing { name, lit, count });

    fn bytes(value: &impl Record) -> Vec<u8> {
        let mut out = Vec::new();
        value.write(&mut out).unwrap();
        out
    }

    #[test]
    fn values_come_back_to_the_bit() {
        let lit = Some(vec![Rgb::new(0.1, -0.0, f64::MIN_POSITIVE), Rgb::splat(1e300)]);
        for thing in [
            Thing { name: Name::Other, lit, count: 7 },
            Thing { name: Name::One, lit: None, count: 0 },
        ] {
            let bytes = bytes(&thing);
            let mut from = Reader::new(&bytes);
            assert_eq!(Thing::read(&mut from), Ok(thing));
            assert_eq!(from.end(), Ok(()));
        }
        assert_eq!(bytes(&Name::Other), [1]);
        assert_eq!(bytes(&Some(2u32)), [1, 2, 0, 0, 0]);
    }

    #[test]
    fn what_is_no_value_is_refused() {
        let refused = |bytes: &[u8]| Thing::read(&mut Reader::new(bytes)).is_err();
        let whole = bytes(&Thing { name: Name::One, lit: Some(vec![Rgb::ZERO]), count: 7 });
        assert!(!refused(&whole));
        assert!((0..whole.len()).all(|length| refused(&whole[..length])));
        assert!(refused(&[&[2], &whole[1..]].concat()));
        // A length of 2⁶⁴ − 1 needs no memory to be refused.
        assert!(Vec::<u8>::read(&mut Reader::new(&[255; 20])).is_err());
        for value in [f64::NAN, f64::INFINITY] {
            assert!(f64::read(&mut Reader::new(&value.to_le_bytes())).is_err());
            assert_eq!(bytes(&Loose(value)), value.to_le_bytes());
        }
        assert!(Reader::new(&[0]).end().is_err());
    }
}
