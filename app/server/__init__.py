"""`python -m app`: who may connect, which messages are accepted, and what is answered."""
