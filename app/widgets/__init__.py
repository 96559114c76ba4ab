"""Parts of the page that several tabs, and the files to download, are made of."""
