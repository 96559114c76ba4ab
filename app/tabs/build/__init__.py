"""The tab Build a top."""
