// What the page was told.

const DATA = JSON.parse(document.getElementById('data').textContent);
