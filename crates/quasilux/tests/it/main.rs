//! Tests of the program as its users meet it: arguments in; files, text and exit codes out.

mod points;
