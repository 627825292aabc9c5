"""Files read and written that a user names, and the forms that they have: JSON, zip, npy, printable text."""
