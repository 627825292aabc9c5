"""The kinds of sensors, actuators, things …: dataclasses whose fields are the arguments that a `.mind` gives them."""
