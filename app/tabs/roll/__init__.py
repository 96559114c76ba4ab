"""Roll: a top that rolls without slipping."""
