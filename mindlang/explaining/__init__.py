"""What the codes of diagnostics mean: the compiler's in `errors.md`, the lint rules' in the rules themselves."""
