//! Numbers to bytes.

/// Bytes that grow.
#[derive(Clone, Debug, Default)]
pub(crate) struct Writer(Vec<u8>);

impl Writer {
    /// Goes on behind these bytes.
    pub(crate) fn behind(bytes: &[u8]) -> Self {
        Self(bytes.to_vec())
    }

    pub(crate) fn u8(&mut self, number: u8) {
        self.0.push(number);
    }

    pub(crate) fn bool(&mut self, flag: bool) {
        self.u8(u8::from(flag));
    }

    pub(crate) fn u32(&mut self, number: u32) {
        self.bytes(&number.to_le_bytes());
    }

    pub(crate) fn u64(&mut self, number: u64) {
        self.bytes(&number.to_le_bytes());
    }

    pub(crate) fn i64(&mut self, number: i64) {
        self.bytes(&number.to_le_bytes());
    }

    pub(crate) fn i128(&mut self, number: i128) {
        self.bytes(&number.to_le_bytes());
    }

    /// By its bits.
    pub(crate) fn f32(&mut self, number: f32) {
        self.u32(number.to_bits());
    }

    /// By its bits.
    pub(crate) fn f64(&mut self, number: f64) {
        self.u64(number.to_bits());
    }

    /// Whether there is one, then what there is.
    pub(crate) fn option<T>(&mut self, thing: Option<T>, put: impl FnOnce(&mut Self, T)) {
        self.bool(thing.is_some());
        if let Some(thing) = thing {
            put(self, thing);
        }
    }

    /// Their number, then each.
    pub(crate) fn f64s(&mut self, numbers: &[f64]) {
        self.u64(numbers.len() as u64);
        numbers.iter().for_each(|number| self.f64(*number));
    }

    /// Its length, then its bytes in UTF-8.
    pub(crate) fn text(&mut self, text: &str) {
        self.u64(text.len() as u64);
        self.bytes(text.as_bytes());
    }

    /// Bytes as they are, without their number.
    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        self.0.extend_from_slice(bytes);
    }

    /// What `put` puts out, with its length before it.
    pub(crate) fn block(&mut self, put: impl FnOnce(&mut Self)) {
        let start = self.0.len();
        self.u64(0);
        put(self);
        let length = (self.0.len() - start - size_of::<u64>()) as u64;
        self.0[start..start + size_of::<u64>()].copy_from_slice(&length.to_le_bytes());
    }

    pub(crate) fn finish(self) -> Vec<u8> {
        self.0
    }
}
