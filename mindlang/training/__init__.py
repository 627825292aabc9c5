"""Teaching: which lessons are due, a run of one begun, watched and written down."""
