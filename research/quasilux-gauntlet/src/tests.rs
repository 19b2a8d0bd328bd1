//! Rooms, and both programs in them.
