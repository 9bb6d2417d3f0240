"""Campaigns of days."""
