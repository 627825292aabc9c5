"""The language server: what an editor asks about `.mind` files, answered from the compiler's own values."""
