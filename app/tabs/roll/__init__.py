"""A top that rolls without slipping."""
