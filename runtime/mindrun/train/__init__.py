"""Training: a learner teaches one skill one lesson, in a run folder that survives anything."""
