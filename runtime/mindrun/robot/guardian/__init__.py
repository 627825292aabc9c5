"""The guardian: a small process that alone moves the actuators, and brings them to neutral when anything goes wrong.

It imports neither numpy nor any code of the user. docs/safety.md says what it promises.
"""
