"""A task for which the agent chooses: which sensors, actuators and subskills a new skill has."""
