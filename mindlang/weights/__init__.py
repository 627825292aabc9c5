"""The weights of a skill as other programs have them, and weights from elsewhere held against the engine."""
