"""Maps that people have: mazes of contests and maps of ROS, made into the text of a map."""
