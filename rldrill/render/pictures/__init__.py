"""Pictures: laid out as scenes for the PDF, and drawn with signs for the terminal."""
