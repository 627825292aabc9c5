"""The weights of a skill as other programs have them, and weights from elsewhere compared with the engine."""
