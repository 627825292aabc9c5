// The schema of robot.yaml has one place, docs/; the extension has a copy in what is built.
const fs = require("fs");
const path = require("path");

fs.copyFileSync(path.join(__dirname, "../../docs/robot.schema.json"), path.join(__dirname, "dist/robot.schema.json"));
