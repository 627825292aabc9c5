"""The language server, over stdio and by its functions; the editor's grammar and extension."""
