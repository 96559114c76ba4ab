"""`python -m app`: who may come in, what they may say, and what is answered."""
