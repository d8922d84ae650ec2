"""Pages: worksheets, keys and the formula sheet, compiled to PDF, and how they are written to files."""
