"""`robot.yaml`: what is wired to what, read and checked against a mind with the same messages as a `.mind` file."""
