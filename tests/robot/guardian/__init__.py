"""What the guardian promises: neutral, whatever happens to whom."""
