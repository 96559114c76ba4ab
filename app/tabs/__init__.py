"""One folder a tab; none knows another."""
