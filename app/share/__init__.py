"""What can be saved or sent: links, files, prints, a page to mail."""
