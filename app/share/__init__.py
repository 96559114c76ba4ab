"""What is taken home: the link, files, prints, the mailed page."""
