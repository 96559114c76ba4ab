"""Parts of the page that several tabs and what is taken home are made of."""
