"""What there is to say of kinds, drivers, codes, words and commands: for a terminal, an editor and the pages of docs/."""
