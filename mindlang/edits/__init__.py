"""The edits of a hierarchy, one a file: a function of a project that says what to splice."""
