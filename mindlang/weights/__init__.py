"""The weights of a skill as other programs have them: named matrices, in the form of safetensors."""
