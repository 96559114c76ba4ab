"""The explorer's page: `panel serve app` finds main.py here."""
