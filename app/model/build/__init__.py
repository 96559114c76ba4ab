"""The builder of tops: dimensions, files, and whether what is built turns over."""
