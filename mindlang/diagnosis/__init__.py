"""What `mindc doctor` looks at, one check a file in `checks/`, and what mends what is missing."""
