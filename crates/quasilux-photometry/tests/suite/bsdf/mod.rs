//! Measured surfaces: files, tables, sampling.

mod corpus;
